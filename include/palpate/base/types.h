// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace palpate {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Vec9 = Eigen::Matrix<double, 9, 1>;  ///< vec() of a Mat3, column-major.
using Mat9 = Eigen::Matrix<double, 9, 9>;

/// `X_AB` maps coordinates in B to coordinates in A.
using Pose = Eigen::Isometry3d;

/// One point per column, 3 x n [m].
using Points = Eigen::Matrix3Xd;

/// Force and torque of one body on another; the declaration states the point and the frame.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 torque = Vec3::Zero();  ///< [N m]

  Wrench& operator+=(const Wrench& other) {
    force += other.force;
    torque += other.torque;
    return *this;
  }
  friend Wrench operator*(double s, const Wrench& w) { return {s * w.force, s * w.torque}; }
  bool allFinite() const { return force.allFinite() && torque.allFinite(); }
};

/// Pose from a position [m] and roll, pitch, yaw about the fixed x, y, z axes [rad] (URDF order).
Pose poseFromXyzRpy(const Vec3& xyz, const Vec3& rpy);

}  // namespace palpate
