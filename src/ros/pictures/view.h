// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/sim/simulator.h"

namespace palpate::node {

inline constexpr double kFieldOfView = 0.7853981852531433;  ///< Of rviz, upright [rad].

/// How a scene is looked at: what frames its organs, and how long arrows are.
struct View {
  Vec3 box_min =
      Vec3::Constant(-0.1);  ///< Of all organs, or of the anatomy where there is none [m].
  Vec3 box_max = Vec3::Constant(0.1);
  Vec3 focus = Vec3::Zero();  ///< The camera looks at this [m] ...
  double distance = 0.5;      ///< ... from so far away [m],
  double yaw = 0.0;           ///< in this direction from it, about z [rad],
  double pitch = 0.0;         ///< and above the horizon [rad].
  double arrow_scale = 0.04;  ///< Of forces [m/N].
  double size() const { return (box_max - box_min).maxCoeff(); }  ///< [m]
};

/// For the organs as they are now and the instruments with all joints at zero.
View makeView(const sim::Simulator& simulator);

/// About the force [N] of a tool that is pressed in by the radius of its tip: the largest of all
/// tools on all organs, or a needle's puncture force. For the length of arrows, not more.
double typicalForce(const sim::Simulator& simulator);

}  // namespace palpate::node
