// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/touch.h"

#include <cmath>

namespace palpate::contact {

Eigen::Matrix<double, 3, 2> tangents(const Vec3& n) {
  const double sign = std::copysign(1.0, n.z());
  const double a = -1.0 / (sign + n.z()), b = n.x() * n.y() * a;
  Eigen::Matrix<double, 3, 2> t;
  t.col(0) << 1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x();
  t.col(1) << b, sign + n.y() * n.y() * a, -n.y();
  return t;
}

PosedObstacle::PosedObstacle(const Obstacle& obstacle, double margin)
    : obstacle_(obstacle),
      margin_(margin),
      radius_(inscribedRadius(*obstacle.geometry) + margin),
      X_GW_(obstacle.X_WG_end.inverse()),
      X_GW_begin_(obstacle.X_WG_begin.inverse()) {}

void PosedObstacle::move(const Obstacle& obstacle) {
  obstacle_ = obstacle;
  X_GW_ = obstacle.X_WG_end.inverse();
  X_GW_begin_ = obstacle.X_WG_begin.inverse();
}

void PosedObstacle::beginHere() {
  obstacle_.X_WG_begin = obstacle_.X_WG_end;
  X_GW_begin_ = X_GW_;
}

void PosedObstacle::measureFrame(Touch* touch) const {
  const Distance distance = signedDistance(*obstacle_.geometry, touch->p_G);
  touch->R_WG = obstacle_.X_WG_end.linear();
  touch->normal_G = distance.normal_G;
  touch->curvature_G = distance.hessian_G;
  touch->steepness = distance.steepness;
  touch->normal_W = obstacle_.X_WG_end.linear() * distance.normal_G;
}

void PosedObstacle::measureMotion(const Vec3& p_begin_W, Touch* touch) const {
  touch->motion_W = obstacle_.X_WG_end.linear() * (touch->p_G - X_GW_begin_ * p_begin_W);
}

}  // namespace palpate::contact
