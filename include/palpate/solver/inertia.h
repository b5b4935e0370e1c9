// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/fem/energy_term.h"

namespace palpate::solver {

/// Inertia of an implicit step as an energy, 1/2 sum_i w_i |x_i - y_i|^2, with y the positions that
/// the masses would reach if nothing held them [the incremental potential of Kane
/// et al. 2000].
class Inertia final : public fem::EnergyTerm {
 public:
  /// Begins a step towards y, 3 x n [m], with the weights s m, n [kg/s^2].
  void beginStep(const Points& y, double s, const Eigen::VectorXd& m);

  /// On each node at x, 3 x n [N]: minus mass times acceleration.
  void forces(const Points& x, Points* f) const;

  double value(const Points& x) const override;
  double addGradient(const Points& x, Points* g) const override;
  void addHessian(const Points& x, fem::Tangent tangent, fem::Stiffness* K) const override;

 private:
  Eigen::VectorXd weights_;
  Points y_;
};

}  // namespace palpate::solver
