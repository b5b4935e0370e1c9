// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/friction.h"
#include "palpate/scene/scene_parts.h"

namespace palpate::scene {

/// The friction of each organ of the scene with the shapes of the instruments, then of the anatomy,
/// as they are numbered in every cycle.
/// @throws InputError for a link that an instrument does not have, or that has no shape.
std::vector<contact::FrictionTable> frictionTables(const Scene& scene, const SceneParts& parts);

}  // namespace palpate::scene
