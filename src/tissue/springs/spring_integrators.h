// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::tissue {

/// How point masses go on in an explicit step of h [s], from velocity v with acceleration a, both
/// at its beginning, damping included.
struct SpringIntegrator {
  const char* name;
  /// The way in the step [m]; v becomes the velocity at its end [m/s].
  Vec3 (*go)(double h, const Vec3& a, Vec3* v);
  /// The longest stable step [s] of a mode of the square of the frequency w2 [1/s^2] that is damped
  /// by the rate d [1/s] at least and d_most at most, x'' + d x' + w2 x = 0. Zero: it grows in any
  /// step.
  double (*longest)(double w2, double d, double d_most);
};

/// forward_euler, velocity and position from the beginning [Wang 2005, (2.7), (2.8)];
/// trapezoidal_euler, whose way is the mean velocity's [CN 103400023 B, step 4.3];
/// symplectic_euler, whose way is the new velocity's.
const std::vector<SpringIntegrator>& springIntegrators();

/// @throws std::invalid_argument for an unknown name.
const SpringIntegrator& springIntegrator(const std::string& name);

}  // namespace palpate::tissue
