// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/keys/fields.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

void describe(keys::FieldVisitor& v, FrictionConfig& friction);
void describe(keys::FieldVisitor& v, FrictionPairConfig& pair);

/// Rule: friction pairs name existing objects of the scene.
void checkFrictionPairs(keys::FieldVisitor& v, const Scene& scene);

}  // namespace palpate::scene
