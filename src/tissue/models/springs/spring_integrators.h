// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::tissue {

/// Explicit integrator of point masses over a step of h [s], from velocity v and acceleration a
/// with damping, both at the begin.
struct SpringIntegrator {
  const char* name;
  /// Returns the displacement [m]; v becomes the velocity at the end [m/s].
  Vec3 (*go)(double h, const Vec3& a, Vec3* v);
  /// Largest stable step [s] of a mode x'' + d x' + w2 x = 0 with w2 [1/s^2] and a damping rate
  /// between d and d_most [1/s]. Zero: unstable for any step.
  double (*longest)(double w2, double d, double d_most);
};

/// forward_euler, velocity and position from the beginning [Wang 2005, (2.7), (2.8)];
/// trapezoidal_euler, whose way is the mean velocity's [CN 103400023 B, step 4.3];
/// symplectic_euler, whose way is the new velocity's.
const std::vector<SpringIntegrator>& springIntegrators();

/// @throws std::invalid_argument for an unknown name.
const SpringIntegrator& springIntegrator(const std::string& name);

}  // namespace palpate::tissue
