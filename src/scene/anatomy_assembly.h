// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/scene/scene_parts.h"

namespace palpate::scene {

/// Reads the surfaces of the anatomy and makes rigid shapes of them; adds repairs to the warnings,
/// and how they were sampled to the notes.
/// @throws InputError
void assembleAnatomy(const Scene& scene, const Progress& progress, SceneParts* parts);

/// Adds a warning for each organ that is in the anatomy before the first cycle, more than a tenth
/// of a millimetre deep.
void warnOfOrgansInAnatomy(const Scene& scene, SceneParts* parts);

}  // namespace palpate::scene
