// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"
#include "palpate/scene/scene_parts.h"

namespace palpate::scene {

/// The rules of what contact.model `prescribed` takes.
void checkPrescribedContact(keys::FieldVisitor& v, const Scene& scene);
/// @throws InputError if it gets a tool that is no segment.
void checkSegments(const Scene& scene, const SceneParts& parts);

}  // namespace palpate::scene
