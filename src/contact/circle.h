// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::contact {

// Computed as long double, as EIGEN_PI is, and rounded once.

inline double perimeter(double radius) { return static_cast<double>(2.0 * EIGEN_PI * radius); }

/// Of the i-th of n points that part a circle evenly [rad].
inline double circleAngle(int i, int n) { return static_cast<double>(2.0 * EIGEN_PI * i / n); }

}  // namespace palpate::contact
