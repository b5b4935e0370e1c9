// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "palpate/instrument/convex_hull.h"
#include "palpate/mesh/convex_hull.h"

namespace palpate::contact {

inline Points randomPoints(std::mt19937* rng, Eigen::Index n, double spread) {
  std::uniform_real_distribution<double> u(-spread, spread);
  return Points::NullaryExpr(3, n, [&] { return u(*rng); });
}

/// A rotation and a shift by at most `shift` [m] along each axis.
inline Pose randomPose(std::mt19937* rng, double shift) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  Pose X = Pose::Identity();
  X.linear() =
      Eigen::Quaterniond(u(*rng), u(*rng), u(*rng), u(*rng)).normalized().toRotationMatrix();
  X.translation() = shift * Vec3(u(*rng), u(*rng), u(*rng));
  return X;
}

inline instrument::ConvexHull hullOf(const Points& points) {
  return instrument::makeConvexHull(mesh::convexHull(points));
}

/// A box about `center` as a hull: its faces are of two triangles each.
inline instrument::ConvexHull hullOfBox(const Vec3& half_extents, const Vec3& center) {
  Points corners(3, 8);
  for (int i = 0; i < 8; ++i) {
    corners.col(i) = center + Vec3((i & 1) ? half_extents.x() : -half_extents.x(),
                                   (i & 2) ? half_extents.y() : -half_extents.y(),
                                   (i & 4) ? half_extents.z() : -half_extents.z());
  }
  return hullOf(corners);
}

/// Of instrument size, one or more a kind.
inline std::vector<std::pair<std::string, instrument::Geometry>> testShapes() {
  std::mt19937 rng{42};
  return {{"sphere", instrument::Sphere{0.005}},
          {"capsule", instrument::Capsule{0.004, 0.02}},
          {"ball capsule", instrument::Capsule{0.004, 0.0}},
          {"cylinder", instrument::Cylinder{0.004, 0.008}},
          {"disc", instrument::Cylinder{0.008, 0.002}},
          {"box", instrument::Box{Vec3(0.002, 0.005, 0.009)}},
          {"cube", instrument::Box{Vec3(0.004, 0.004, 0.004)}},
          {"hull of a box", hullOfBox(Vec3(0.002, 0.005, 0.009), Vec3(0.003, 0.0, -0.004))},
          {"hull of a cloud", hullOf(randomPoints(&rng, 40, 0.008))},
          {"hull of a simplex", hullOf(randomPoints(&rng, 4, 0.008))}};
}

}  // namespace palpate::contact
