// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <string>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::sim {

/// Where the hand means to be at a time, away from where it begins [m], and how fast it goes
/// there [m/s], and what pushes it beside [N].
struct HandIntent {
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero(), push = Vec3::Zero();
};

/// What a hand means to do with a tool that begins `above` a surface [m].
struct HandMotionSettings {
  std::string motion = "press";
  double above = 0.005;  ///< [m]
  double depth = 0.004;  ///< Below the surface [m].
  double speed = 0.03;   ///< On the way down [m/s].
};

/// The motions that loops through the hand are judged by:
///   press   down, and stay;
///   tremor  and then tremble by 2 mm at 4 Hz;
///   slide   and then 20 mm aside in half a second;
///   taps    down and up again, twice a second, as smoothly as a cosine;
///   wander  to random places within 20 mm aside, from above the surface to the depth, each in 0.2
///           to 1 s; the same ones each time.
class HandMotion {
 public:
  /// @throws std::invalid_argument for an unknown motion, or a speed that is not > 0.
  explicit HandMotion(const HandMotionSettings& settings);

  /// Times may not go back.
  HandIntent at(double t);

  static const std::vector<std::string>& names();

 private:
  HandIntent wander(double t);

  HandMotionSettings settings_;
  double down_ = 0.0;  // when it is down [s]
  std::mt19937 random_{7};
  Vec3 from_ = Vec3::Zero(), to_ = Vec3::Zero();
  double begin_ = 0.0, duration_ = 0.0;
};

}  // namespace palpate::sim
