// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "palpate/contact/touch.h"

namespace palpate::contact {

/// Bound of the gradient of a sampled distance between grid points [-].
constexpr double kSteepestDistance = 1.25;
constexpr double kDistanceRounding = 1e-9;

/// Bounding ball of samples of a triangle, in barycentric terms, valid for any corner positions.
/// Where it is far from an obstacle, all its samples are skipped.
struct SampleBall {
  Vec3 middle = Vec3::Zero();  ///< Barycentric coordinates of the middle.
  double spread = 0.0;         ///< Radius over the triangle's longest edge [-].

  /// Ball of the samples [begin, end) with barycentric coordinates weights(s).
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
    // Points with weights v, w are at most sum |v - w| / 2 longest edges apart.
    for (int s = begin; s < end; ++s) {
      ball.spread = std::max(ball.spread, 0.5 * (weights(s) - ball.middle).template lpNorm<1>());
    }
    return ball;
  }

  /// Lower bound of the samples' gaps [m], or NaN. `corners`: 3 x 3 [m]; `offset`: largest offset
  /// of a sample [m]; `error`: distanceError() [m].
  double leastGap(const Mat3& corners, double offset, const PosedObstacle& posed,
                  double error) const;
};

/// Consecutive samples [begin, end) of a triangle.
struct SamplePart {
  int begin, end;
  SampleBall ball;
};

}  // namespace palpate::contact
