// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>

#include "palpate/base/types.h"
#include "palpate/fem/supports.h"

namespace palpate::tissue {

/// A held point of a triangle, p = sum w_i x_i with shape functions w_i of its nodes. Each
/// component is a constraint w . u = d; its force l is the multiplier, and acts on node i as w_i l.
///
/// The constraint eliminates the pivot, the node of largest weight: u = Z v + m with w . m = d, and
/// Z' K Z v = -Z' (g + K m) [Castillo Leon 2011, (7.2), (7.3)]. Held components are left out.
class TiedPoint {
 public:
  TiedPoint() = default;  ///< Holds nothing.
  /// `free`: components free of supports, 3 x n.
  TiedPoint(const Eigen::Vector3i& nodes, const Vec3& weights, const fem::FreeMask& free);

  /// Whether all three components of the point can move.
  bool free() const { return *std::min_element(pivots_.begin(), pivots_.end()) >= 0; }
  /// Adds the least nodal displacements that move the point by `way` [m] to `move`, 3 x n [m].
  void addMove(const Vec3& way, Points* move) const;
  /// Sum of the internal forces at the free nodes [N]: (7.5).
  Vec3 force(const Points& gradient) const;
  /// Subtracts the constraint force from `gradient`, 3 x n [N]; zero at the nodes in equilibrium.
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
