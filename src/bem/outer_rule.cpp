// SPDX-License-Identifier: GPL-3.0-or-later
#include "outer_rule.h"

#include <cmath>

namespace palpate::bem {
namespace {

constexpr double kNear = 0.5, kFar = 4.0;  // gap over the size

// Gauss-Legendre on [0, 1].
constexpr int kGauss = 5;
constexpr double kAt[kGauss] = {0.046910077030668018, 0.23076534494715845, 0.5, 0.7692346550528415,
                                0.95308992296933193};
constexpr double kWeight[kGauss] = {0.11846344252809471, 0.2393143352496831, 0.2844444444444445,
                                    0.2393143352496831, 0.11846344252809471};

// In three parts about the centroid, in directions outward and along the edge, denser towards edges
// and corners.
OuterRule crowded() {
  OuterRule rule;
  rule.at.resize(3, 3 * kGauss * kGauss);
  rule.weights.resize(3 * kGauss * kGauss);
  Eigen::Index k = 0;
  for (int edge = 0; edge < 3; ++edge) {
    for (int i = 0; i < kGauss; ++i) {
      const double rest = 1.0 - kAt[i], out = 1.0 - rest * rest;
      for (int j = 0; j < kGauss; ++j, ++k) {
        const double t = kAt[j], along = t * t * (3.0 - 2.0 * t);
        rule.at.col(k).setConstant((1.0 - out) / 3.0);
        rule.at(edge, k) += out * (1.0 - along);
        rule.at((edge + 1) % 3, k) += out * along;
        rule.weights[k] =
            2.0 / 3.0 * out * kWeight[i] * 2.0 * rest * kWeight[j] * 6.0 * t * (1.0 - t);
      }
    }
  }
  rule.weights /= rule.weights.sum();
  return rule;
}

// Degree 5, seven points.
OuterRule ofSeven() {
  OuterRule rule;
  rule.at.resize(3, 7);
  rule.weights.resize(7);
  rule.at.col(6).setConstant(1.0 / 3.0);
  rule.weights[6] = 0.225;
  const double root = std::sqrt(15.0);
  for (const int sign : {0, 1}) {
    const double part = (6.0 + (sign ? root : -root)) / 21.0;
    for (int a = 0; a < 3; ++a) {
      rule.at.col(3 * sign + a).setConstant(part);
      rule.at(a, 3 * sign + a) = 1.0 - 2.0 * part;
      rule.weights[3 * sign + a] = (155.0 + (sign ? root : -root)) / 1200.0;
    }
  }
  return rule;
}

// Degree 2, three points.
OuterRule ofThree() {
  OuterRule rule;
  rule.at = Eigen::Matrix3d::Constant(1.0 / 6.0) + 0.5 * Eigen::Matrix3d::Identity();
  rule.weights = Eigen::Vector3d::Constant(1.0 / 3.0);
  return rule;
}

}  // namespace

const OuterRule& outerRule(const Triangle& over, const Triangle& source) {
  static const OuterRule kNearRule = crowded(), kMiddleRule = ofSeven(), kFarRule = ofThree();
  const double gap = (over.middle - source.middle).norm() - over.radius - source.radius;
  if (gap < kNear * over.radius) return kNearRule;
  return gap < kFar * over.radius ? kMiddleRule : kFarRule;
}

}  // namespace palpate::bem
