// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample_ball.h"

#include <cmath>

namespace palpate::contact {

double SampleBall::leastGap(const Mat3& corners, double offset, const PosedObstacle& posed,
                            double error) const {
  const Vec3 a = corners.col(0), b = corners.col(1), c = corners.col(2);
  const double longest =
      std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
  const double radius = spread * longest + offset;
  const double gap = posed.gap(middle[0] * a + middle[1] * b + middle[2] * c);
  const double steepest = error > 0.0 ? kSteepestDistance : 1.0;
  return gap - steepest * radius - 2.0 * error - kDistanceRounding * (std::abs(gap) + radius);
}

}  // namespace palpate::contact
