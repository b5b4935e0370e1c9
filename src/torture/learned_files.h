// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// Keys of an organ of models enriched and neural; else empty.
std::string learnedText(const TortureOrgan& organ);

/// Makes the files of these keys in the scene's folder by presses of the organ; about a second.
/// @throws InputError if too few presses are solved.
void writeLearned(const TortureScene& scene, const std::string& scene_file,
                  const std::string& folder);

}  // namespace palpate::torture
