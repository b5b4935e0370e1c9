// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "palpate/contact/touch.h"

namespace palpate::contact {

/// A sampled distance may be steeper than 1 between the points where it is exact.
constexpr double kSteepestDistance = 1.25;
constexpr double kDistanceRounding = 1e-9;

/// Around samples of a triangle that lie close together, wherever its corners go. Where its middle
/// is far from an obstacle all of them are, and nobody need look at one.
struct SampleBall {
  Vec3 middle = Vec3::Zero();  ///< Barycentric.
  double spread = 0.0;         ///< Around it, at most, of the triangle's longest edge.

  /// Of samples [begin, end), which have the barycentric coordinates weights(s).
  template <class Weights>
  static SampleBall around(int begin, int end, const Weights& weights) {
    Vec3 low = weights(begin), high = low;
    for (int s = begin; s < end; ++s) {
      low = low.cwiseMin(weights(s));
      high = high.cwiseMax(weights(s));
    }
    SampleBall ball;
    ball.middle = 0.5 * (low + high);
    ball.middle /= ball.middle.sum();
    // Between points of a triangle with weights v and w there is at most half of sum |v - w| of
    // its longest edge.
    for (int s = begin; s < end; ++s) {
      ball.spread = std::max(ball.spread, 0.5 * (weights(s) - ball.middle).template lpNorm<1>());
    }
    return ball;
  }

  /// A gap [m] below those of all samples, or not a number. `corners`: 3 x 3 [m]; `offset` [m]: of
  /// a sample from its triangle, at most; `error` [m]: see distanceError().
  double leastGap(const Mat3& corners, double offset, const PosedObstacle& posed,
                  double error) const;
};

/// Samples [begin, end) of a triangle, which follow one another.
struct SamplePart {
  int begin, end;
  SampleBall ball;
};

}  // namespace palpate::contact
