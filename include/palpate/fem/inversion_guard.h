// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/fem/energy_term.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::fem {

/// Keeps elements from being turned inside out: an energy per rest volume of each tetrahedron
///
///   k b(J),   b = -(J0 - J)^2 ln(J / J0)   for J < J0,
///
/// of its det F = J. It is twice continuously differentiable at J0, where it begins, and rises
/// without bound towards 0 [the barrier of Li et al. 2020, Incremental Potential Contact, eq. 6,
/// with volumes for distances]; under J0 / 10 it goes on as its parabola there, so that an element
/// that is inverted is brought back. Quadratic tetrahedra are eight small ones. Switched off, as at
/// first, it costs nothing.
class InversionGuard final : public EnergyTerm {
 public:
  /// J0: tissue that keeps its volume is never so flat.
  static constexpr double kLeast = 0.1;

  /// `stiffness`: k [Pa].
  InversionGuard(const mesh::TetMesh& mesh, double stiffness);

  /// From now on it keeps these tetrahedra only, of a mesh that is not quadratic.
  void keepOnly(const std::vector<int>& tets);
  /// The smallest J at x, 3 x n [m].
  double least(const Points& x) const;
  void setActive(bool active) { active_ = active; }
  bool active() const { return active_; }

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, Tangent tangent, Stiffness* K) const override;

 private:
  Mat3 edges(const Points& x, Eigen::Index e) const;
  /// visit(element, edges, J) of those flatter than J0.
  template <class Visit>
  void forFlat(const Points& x, const Visit& visit) const;

  Eigen::Matrix4Xi tets_;
  Eigen::VectorXd volumes_;  // at rest, times six [m^3]
  double stiffness_;
  bool active_ = false;
};

}  // namespace palpate::fem
