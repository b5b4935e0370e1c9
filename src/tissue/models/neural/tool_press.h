// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/obstacle.h"

namespace palpate::tissue {

/// Deepest penetration of a tool into a fixed surface, and the displacement that resolves it.
struct ToolPress {
  double depth = 0.0;  ///< Penetration [m]; 0: no contact.
  int triangle = -1;
  Vec3 weights = Vec3::Zero();   ///< Barycentric coordinates in the triangle.
  Vec3 normal_W = Vec3::Zero();  ///< Normal of the tool, outward, world.
  Vec3 p_W = Vec3::Zero();       ///< Point on the tool to which the surface point moves, world [m].
  /// Radius of curvature of the tool [m]; 0 where flat or of two very different curvatures.
  double radius = 0.0;

  /// [m]
  Vec3 displacement() const { return depth * normal_W; }
};

/// Finds the presses of tools into a surface.
class PressFinder {
 public:
  /// `X`: positions, world, 3 x n [m]; `triangles`: outward.
  PressFinder(const Points& X, const Eigen::Matrix3Xi& triangles);

  /// Press of the obstacle at its end pose. In each candidate triangle by alternating projections
  /// onto it and the tool reduced by its inscribed ball [Cheney, Goldstein 1959]: exact for a ball,
  /// convergent for convex tools.
  ToolPress find(const contact::Obstacle& obstacle) const;

 private:
  bool mayTouch(const contact::Obstacle& obstacle) const;
  ToolPress findIn(const contact::Obstacle& obstacle, Eigen::Index triangle) const;

  Points X_;
  Eigen::Matrix3Xi triangles_;
  Eigen::VectorXd farthest_;  // largest distance of a triangle's point from its nearest corner [m]
  Vec3 low_, high_;
};

}  // namespace palpate::tissue
