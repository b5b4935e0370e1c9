// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/contact/obstacle.h"

namespace palpate::tissue {

/// Where a tool is deepest in a surface that does not move, and what would free that place of it.
struct ToolPress {
  double depth = 0.0;  ///< [m]; 0: it does not touch.
  int triangle = -1;
  Vec3 weights = Vec3::Zero();   ///< Of the triangle's corners.
  Vec3 normal_W = Vec3::Zero();  ///< Of the tool there, outward.
  Vec3 p_W = Vec3::Zero();       ///< Where the place then is [m]: on the tool.
  /// Of curvature of the tool there [m]; 0 where it is flat, or round one way much more than the
  /// other.
  double radius = 0.0;

  /// [m]
  Vec3 displacement() const { return depth * normal_W; }
};

/// Finds presses of a surface.
class PressFinder {
 public:
  /// `X`: points in the world, 3 x n [m]; `triangles`: outward.
  PressFinder(const Points& X, const Eigen::Matrix3Xi& triangles);

  /// Of the obstacle where it ends. In each triangle that may be deepest by alternating projections
  /// onto it and onto the tool less what its inscribed ball takes off [Cheney, Goldstein 1959]: of
  /// a ball exact in one, of convex tools it converges.
  ToolPress find(const contact::Obstacle& obstacle) const;

 private:
  bool mayTouch(const contact::Obstacle& obstacle) const;
  ToolPress findIn(const contact::Obstacle& obstacle, Eigen::Index triangle) const;

  Points X_;
  Eigen::Matrix3Xi triangles_;
  Eigen::VectorXd farthest_;  // of a triangle's points from the nearest corner, at most [m]
  Vec3 low_, high_;
};

}  // namespace palpate::tissue
