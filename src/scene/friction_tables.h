// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/friction.h"
#include "palpate/scene/scene_parts.h"

namespace palpate::scene {

/// Friction of each organ with the shapes of the instruments, then of the anatomy, in the order of
/// obstacles in a cycle.
/// @throws InputError for an unknown link, or one without shape.
std::vector<contact::FrictionTable> frictionTables(const Scene& scene, const SceneParts& parts);

}  // namespace palpate::scene
