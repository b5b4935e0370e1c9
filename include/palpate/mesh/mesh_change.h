// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::mesh {

/// Lumped masses of a mesh [kg].
struct LumpedMasses {
  Eigen::VectorXd points;  ///< Of each point.
  /// 4 x m or 10 x m: what each tetrahedron gives to its nodes, middle ones last. Linear meshes can
  /// do without.
  Eigen::MatrixXd shares;
};

/// How one nested mesh became another one of the same body, and what becomes of linear fields, or
/// of quadratic ones where the meshes are quadratic. Old and new points and tetrahedra are named by
/// their numbers in the old and new mesh.
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

  /// A new point inside an old tetrahedron, which has these nodes and there these shape functions.
  struct Inside {
    int point;
    std::array<int, 10> nodes;
    std::array<double, 10> values;
  };
  /// What there is besides of quadratic meshes; without columns the meshes are linear.
  Eigen::Matrix<int, 10, Eigen::Dynamic> old_nodes, new_nodes;
  /// Takes the place of `added` and `removed`, which then have nothing: every point of the coarser
  /// of two quadratic meshes is one of the finer.
  std::vector<Inside> inside;
  /// Of each new tetrahedron with each old one of its range, one after the other: barycentric
  /// coordinates of the corners of the smaller in the larger, a column each.
  std::vector<Eigen::Matrix4d> corners;

  int numNewPoints() const { return static_cast<int>(old_point.size()); }
  bool quadratic() const { return new_nodes.cols() > 0; }

  /// The field of `old`, k values a point, at the new points: interpolated, which changes nothing
  /// where tetrahedra were split.
  Eigen::MatrixXd interpolate(const Eigen::MatrixXd& old) const;
  /// The same for velocities or other fields that have an amount: what the interpolation changes of
  /// the amount, sum of mass times value, is given to the points around, so that the amount is kept
  /// to rounding and a linear field stays what it is. In a linear mesh that is something where
  /// tetrahedra were joined. In a quadratic one, lumped masses do not sum quadratic fields exactly:
  /// there the nodes of each tetrahedron that was split or became of several get, all alike, what
  /// its nodes had more. Masses are those of the same density before and after.
  Eigen::MatrixXd transport(const Eigen::MatrixXd& old, const LumpedMasses& old_masses,
                            const LumpedMasses& new_masses) const;

 private:
  void keepAmount(const Eigen::MatrixXd& old, const LumpedMasses& old_masses,
                  const LumpedMasses& new_masses, Eigen::MatrixXd* field) const;
};

}  // namespace palpate::mesh
