// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/types.h"

namespace palpate {

Pose poseFromXyzRpy(const Vec3& xyz, const Vec3& rpy) {
  Pose X = Pose::Identity();
  X.linear() =
      (Eigen::AngleAxisd(rpy.z(), Vec3::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Vec3::UnitY()) *
       Eigen::AngleAxisd(rpy.x(), Vec3::UnitX()))
          .toRotationMatrix();
  X.translation() = xyz;
  return X;
}

}  // namespace palpate
