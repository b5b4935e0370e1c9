// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>

#include "palpate/base/types.h"
#include "palpate/fem/supports.h"

namespace palpate::tissue {

/// A point of a triangle that is held, p = sum w_i x_i with the shape functions w_i of its nodes,
/// and nothing else of them: of three nodes three components are known, as of a node that is held.
/// Each component is a condition w . u = d on its own. Its force l is the multiplier, and acts on
/// node i as w_i l.
///
/// The known component takes the place of the pivot's, the node of largest weight: u = Z v + m with
/// w . m = d, and Z' K Z v = -Z' (g + K m) is the system of the unknown ones [Castillo Leon 2011,
/// (7.2), (7.3)]. Components that supports hold are left out of a condition.
class TiedPoint {
 public:
  TiedPoint() = default;  ///< Holds nothing.
  /// `free`: what the supports leave, 3 x n.
  TiedPoint(const Eigen::Vector3i& nodes, const Vec3& weights, const fem::FreeMask& free);

  /// Whether all three components can be moved.
  bool free() const { return *std::min_element(pivots_.begin(), pivots_.end()) >= 0; }
  /// Adds to the nodes' moves the least ones by which the point goes by `way` [m].
  void addMove(const Vec3& way, Points* move) const;
  /// The internal forces at the nodes, summed where they are free [N]: (7.5).
  Vec3 force(const Points& gradient) const;
  /// What the point's force leaves of the gradient: in balance it is zero at its nodes.
  void balance(Points* gradient) const;
  /// Norm of the forces on the nodes [N].
  double nodalNorm(const Points& gradient) const;

  /// Z' A Z, with the pivots' own terms on the diagonal.
  void reduce(Eigen::SparseMatrix<double>* A) const;
  /// Z' right.
  void reduce(Points* right) const;
  /// Z v.
  void expand(Points* v) const;

 private:
  Vec3 multiplier(const Points& gradient) const;

  Eigen::Vector3i nodes_ = Eigen::Vector3i::Zero();
  Mat3 weights_ = Mat3::Zero();            // of component c (row) at node k; 0 where held
  std::array<int, 3> pivots_{-1, -1, -1};  // by component, a corner; -1: no condition
};

}  // namespace palpate::tissue
