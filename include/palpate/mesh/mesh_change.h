// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/types.h"

namespace palpate::mesh {

/// How one nested mesh became another one of the same body, and what becomes of linear fields. Old
/// and new points and tetrahedra are named by their numbers in the old and new mesh.
struct MeshChange {
  /// A point in the middle between two others.
  struct Middle {
    int point, a, b;
  };

  int num_old_points = 0;
  std::vector<int> old_point;   ///< Of each new point; -1: it was not there.
  std::vector<Middle> added;    ///< New points, after those that they are between.
  std::vector<Middle> removed;  ///< Old points, before those that they are between.
  /// Of each new tetrahedron: it consists of the old ones first .. last - 1, or is part of `first`
  /// if last = first + 1.
  struct Range {
    int first, last;
  };
  std::vector<Range> tets;

  int numNewPoints() const { return static_cast<int>(old_point.size()); }

  /// The field of `old`, k values a point, at the new points: interpolated, which changes nothing
  /// where tetrahedra were split.
  Eigen::MatrixXd interpolate(const Eigen::MatrixXd& old) const;
  /// The same for velocities or other fields that have an amount: what the interpolation loses of
  /// the amount, sum of mass times value, where tetrahedra were joined, is given to the points
  /// around, so that the amount is kept to rounding and a linear field stays what it is. Masses of
  /// old and new points are lumped ones of the same density.
  Eigen::MatrixXd transport(const Eigen::MatrixXd& old, const Eigen::VectorXd& old_masses,
                            const Eigen::VectorXd& new_masses) const;
};

}  // namespace palpate::mesh
