// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "palpate/scene/scene.h"
#include "palpate/sim/hand_loop.h"

namespace palpate::cli {

/// What `palpate hand` was asked for.
struct HandOptions {
  std::string scene, out, grip = "light", motion = "press";
  std::optional<double> passivity, mass, damping, stiffness, grip_damping, resolution;
  double depth = 0.004, speed = 0.03, push = 0.0, duration = 5.0;
  double rate = 100.0, solve = 0.005, delay_in = 0.0, delay_out = 0.0, device_rate = 1000.0;
  bool hold = false, late = false, untold = false, prescribed = false;
};

std::vector<std::string> gripNames();
/// What the grip leans on the tool with, instead of meaning to be somewhere [N].
double gripPush(const HandOptions& options);
/// @throws what main() shows, for a number that is none, by its option.
void checkNumbers(const HandOptions& options);
/// The loop through the hand on the scene's only instrument.
sim::HandLoopSettings settingsFrom(const HandOptions& options, const scene::Scene& scene);

}  // namespace palpate::cli
