// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "palpate/scene/scene.h"

namespace palpate::cli {

/// Keys with what stands for them, in the order of the scene format: ("solver.step", "0.01").
using Settings = std::vector<std::pair<std::string, std::string>>;

/// Sets keys of a scene's sections `solver` and `contact`, every one that the scene format has, as
/// if the file said so.
/// @throws InputError with all that is wrong: unknown keys (with the nearest known one), values out
/// of range, broken rules.
void applySettings(const Settings& settings, scene::Scene* scene);

/// All keys of these sections that hold, with their values.
Settings settingsOf(const scene::Scene& scene);

}  // namespace palpate::cli
