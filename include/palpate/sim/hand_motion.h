// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <string>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::sim {

/// Intended position relative to the start [m], its velocity [m/s], and an external force [N].
struct HandIntent {
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero(), push = Vec3::Zero();
};

/// Parameters of an intended motion above a surface.
struct HandMotionSettings {
  std::string motion = "press";
  double above = 0.005;  ///< [m]
  double depth = 0.004;  ///< Below the surface [m].
  double speed = 0.03;   ///< On the way down [m/s].
};

/// Intended motions for tests of force loops:
///   press   down, then hold;
///   tremor  press, then oscillate by 2 mm at 4 Hz;
///   slide   press, then 20 mm aside in 0.5 s;
///   taps    down and up by a cosine, twice a second;
///   wander  to pseudorandom positions within 20 mm aside, above the surface to the depth,
/// each in 0.2 to 1 s, with a fixed seed.
class HandMotion {
 public:
  /// @throws std::invalid_argument for an unknown motion, or a speed that is not > 0.
  explicit HandMotion(const HandMotionSettings& settings);

  /// Intent at time t [s].
  /// @pre Times do not decrease.
  HandIntent at(double t);

  static const std::vector<std::string>& names();

 private:
  HandIntent wander(double t);

  HandMotionSettings settings_;
  double down_ = 0.0;  // end of the way down [s]
  std::mt19937 random_{7};
  Vec3 from_ = Vec3::Zero(), to_ = Vec3::Zero();
  double begin_ = 0.0, duration_ = 0.0;
};

}  // namespace palpate::sim
