// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool_press.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/contact/signed_distance.h"
#include "palpate/contact/triangle_distance.h"

namespace palpate::tissue {
namespace {

constexpr int kProjections = 30;
constexpr double kRounder = 1.0 / 3.0;  // largest difference of two curvatures over their sum [-]

// For a curvature k of the shape, the distance has the second derivative k / (1 - depth k).
double radiusOf(const contact::Distance& d) {
  const double sum = d.hessian_G.trace();
  const double apart = std::sqrt(std::max(0.0, 2.0 * d.hessian_G.squaredNorm() - sum * sum));
  return sum > 0.0 && apart <= kRounder * sum ? 2.0 / sum - d.value : 0.0;
}

}  // namespace

PressFinder::PressFinder(const Points& X, const Eigen::Matrix3Xi& triangles)
    : X_(X), triangles_(triangles), farthest_(triangles.cols()) {
  low_.setConstant(std::numeric_limits<double>::infinity());
  high_ = -low_;
  for (Eigen::Index t = 0; t < triangles_.cols(); ++t) {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 x = X_.col(triangles_(k, t)), next = X_.col(triangles_((k + 1) % 3, t));
      longest = std::max(longest, (next - x).norm());
      low_ = low_.cwiseMin(x);
      high_ = high_.cwiseMax(x);
    }
    farthest_[t] = longest / std::sqrt(3.0);
  }
}

bool PressFinder::mayTouch(const contact::Obstacle& obstacle) const {
  const Vec3 middle = obstacle.X_WG_end.translation();
  const Vec3 outside = (low_ - middle).cwiseMax(middle - high_).cwiseMax(0.0);
  return outside.norm() < contact::boundingRadius(*obstacle.geometry);
}

ToolPress PressFinder::findIn(const contact::Obstacle& obstacle, Eigen::Index triangle) const {
  const Pose X_GW = obstacle.X_WG_end.inverse();
  const double ball = contact::inscribedRadius(*obstacle.geometry);
  Mat3 corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = X_GW * Vec3(X_.col(triangles_(k, triangle)));
  ToolPress press;
  press.triangle = static_cast<int>(triangle);
  press.weights.setConstant(1.0 / 3.0);
  Vec3 p = corners * press.weights;
  contact::Distance d = contact::signedDistance(*obstacle.geometry, p);
  for (int k = 0; k < kProjections; ++k) {
    const Vec3 within = p - (d.value + ball) * d.normal_G;
    const contact::TrianglePoint near =
        contact::nearestOnTriangle(within, corners.col(0), corners.col(1), corners.col(2));
    const contact::Distance there = contact::signedDistance(*obstacle.geometry, near.point);
    if (!(there.value < d.value)) break;
    const bool same = (near.point - p).norm() < 1e-9 * farthest_[triangle];
    p = near.point;
    press.weights = near.weights;
    d = there;
    if (same) break;
  }
  press.depth = -d.value;
  press.normal_W = obstacle.X_WG_end.linear() * d.normal_G;
  press.p_W = obstacle.X_WG_end * p + press.displacement();
  press.radius = radiusOf(d);
  return press;
}

ToolPress PressFinder::find(const contact::Obstacle& obstacle) const {
  ToolPress deepest;
  if (!mayTouch(obstacle)) return deepest;
  const Pose X_GW = obstacle.X_WG_end.inverse();
  for (Eigen::Index t = 0; t < triangles_.cols(); ++t) {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      least = std::min(least, contact::signedDistanceValue(*obstacle.geometry,
                                                           X_GW * Vec3(X_.col(triangles_(k, t)))));
    }
    if (!(least - farthest_[t] < -deepest.depth)) continue;
    const ToolPress press = findIn(obstacle, t);
    if (press.depth > deepest.depth) deepest = press;
  }
  return deepest;
}

}  // namespace palpate::tissue
