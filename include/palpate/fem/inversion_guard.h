// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/fem/energy_term.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::fem {

/// Prevents inversion of elements by an energy per rest volume of each tetrahedron
///
///   k b(J),   b = -(J0 - J)^2 ln(J / J0)   for J < J0,
///
/// of its det F = J. The energy is C2 at J0 and grows without bound towards J = 0 [the barrier of
/// Li et al. 2020, Incremental Potential Contact, eq. 6, with volumes for distances]. Below J0 / 10
/// the tangent parabola at J0 / 10 replaces the barrier, so inverted elements are restored.
/// Quadratic tetrahedra count as eight linear ones. Initially off, without cost.
class InversionGuard final : public EnergyTerm {
 public:
  /// J0 [-]; nearly incompressible tissue stays above.
  static constexpr double kLeast = 0.1;

  /// `stiffness`: k [Pa].
  InversionGuard(const mesh::TetMesh& mesh, double stiffness);

  /// Restricts the guard to these tetrahedra of a linear mesh.
  void keepOnly(const std::vector<int>& tets);
  /// The smallest J of a tetrahedron with volume at x, 3 x n [m], or 1 if all are larger.
  double least(const Points& x) const;
  void setActive(bool active) { active_ = active; }
  bool active() const { return active_; }

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, Tangent tangent, Stiffness* K) const override;

 private:
  Mat3 edges(const Points& x, Eigen::Index e) const;
  /// Calls visit(element, edges, J) for elements with J < J0.
  template <class Visit>
  void forFlat(const Points& x, const Visit& visit) const;

  Eigen::Matrix4Xi tets_;
  Eigen::VectorXd volumes_;  // 6 times the rest volume [m^3]
  double stiffness_;
  bool active_ = false;
};

}  // namespace palpate::fem
