// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/scene/scene_parts.h"

namespace palpate::scene {

/// Reads the surfaces of the anatomy and makes rigid shapes. Adds repairs to the warnings and the
/// resolution of sampling to the notes.
/// @throws InputError
void assembleAnatomy(const Scene& scene, const Progress& progress, SceneParts* parts);

/// Adds a warning for each organ that penetrates the anatomy by more than 0.1 mm before the first
/// cycle.
void warnOfOrgansInAnatomy(const Scene& scene, SceneParts* parts);

}  // namespace palpate::scene
