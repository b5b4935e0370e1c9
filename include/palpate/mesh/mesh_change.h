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

/// Change between nested meshes of a body, with the transfer of linear or quadratic fields. Old and
/// new indices are those of the old and new mesh.
struct MeshChange {
  /// A midpoint of two points.
  struct Middle {
    int point, a, b;
  };

  int num_old_points = 0;
  std::vector<int> old_point;   ///< Old index of each new point; -1: added.
  std::vector<Middle> added;    ///< Added points, after their ends.
  std::vector<Middle> removed;  ///< Removed points, before their ends.
  /// Source of each new tetrahedron: the union of old ones first .. last - 1, or part of `first` if
  /// last = first + 1.
  struct Range {
    int first, last;
  };
  std::vector<Range> tets;

  /// A new point in an old tetrahedron: its nodes and shape functions.
  struct Inside {
    int point;
    std::array<int, 10> nodes;
    std::array<double, 10> values;
  };
  /// Additional data of quadratic meshes; without columns: linear.
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
