// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"
#include "palpate/scene/scene_parts.h"

namespace palpate::scene {

/// Rules of contact.model `prescribed`.
void checkPrescribedContact(keys::FieldVisitor& v, const Scene& scene);
/// @throws InputError for a tool that is not a segment, if the model is `prescribed`.
void checkSegments(const Scene& scene, const SceneParts& parts);

}  // namespace palpate::scene
