// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/rigid_contact.h"

#include <algorithm>
#include <cmath>

#include "palpate/contact/signed_distance.h"

namespace palpate::contact {
namespace {

// x to the eighth, and to the seventh.
double toPower(double x) {
  static_assert(kDepthPower == 8);
  const double x2 = x * x, x4 = x2 * x2;
  return x4 * x4;
}

double toPowerLessOne(double x) { return x * x * x * (x * x) * (x * x); }

}  // namespace

RigidContact::RigidContact(const instrument::Geometry* fixed, const Pose& X_WG, double stiffness)
    : fixed_(fixed),
      X_WG_(X_WG),
      X_GW_(X_WG.inverse()),
      stiffness_(stiffness),
      error_(distanceError(*fixed)) {}

void RigidContact::clear() { touches_.clear(); }

bool RigidContact::add(const std::vector<TouchBall>& balls, double bounding_radius,
                       const Pose& X_WT) {
  const Pose X_GT = X_GW_ * X_WT;
  if (!mayTouch(bounding_radius, X_GT.translation())) return false;
  for (const TouchBall& ball : balls) {
    const Vec3 center = X_GT * ball.center_G;
    if (!(signedDistanceValue(*fixed_, center) < ball.radius)) continue;
    const Distance distance = signedDistance(*fixed_, center);
    // Not yet the force, but the gradient of the gap.
    touches_.push_back({X_WG_ * Vec3(center - ball.radius * distance.normal_G),
                        ball.radius - distance.value,
                        X_WG_.linear() * (distance.steepness * distance.normal_G)});
  }
  return true;
}

bool RigidContact::mayTouch(double bounding_radius, const Vec3& origin_G) const {
  return signedDistanceValue(*fixed_, origin_G) <= bounding_radius + error_;
}

bool RigidContact::wouldTouch(const std::vector<TouchBall>& balls, double bounding_radius,
                              const Pose& X_WT) const {
  const Pose X_GT = X_GW_ * X_WT;
  if (!mayTouch(bounding_radius, X_GT.translation())) return false;
  return std::any_of(balls.begin(), balls.end(), [&](const TouchBall& ball) {
    return signedDistanceValue(*fixed_, X_GT * ball.center_G) < ball.radius;
  });
}

double RigidContact::solve() {
  double deepest = 0.0;
  for (const RigidTouch& touch : touches_) deepest = std::max(deepest, touch.depth);
  if (!(deepest > 0.0)) return 0.0;
  double sum = 0.0;
  for (const RigidTouch& touch : touches_) sum += toPower(touch.depth / deepest);
  const double stretch = deepest * std::pow(sum, 1.0 / kDepthPower);
  for (RigidTouch& touch : touches_) {
    touch.force_W *= stiffness_ * stretch * toPowerLessOne(touch.depth / stretch);
  }
  return 0.5 * stiffness_ * stretch * stretch;
}

}  // namespace palpate::contact
