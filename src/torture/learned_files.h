// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// The keys of an organ that learned, of models enriched and neural; else nothing.
std::string learnedText(const TortureOrgan& organ);

/// Makes what these name in the scene's folder, by presses of the organ; a second or so.
/// @throws InputError where too few presses are solved to learn from.
void writeLearned(const TortureScene& scene, const std::string& scene_file,
                  const std::string& folder);

}  // namespace palpate::torture
