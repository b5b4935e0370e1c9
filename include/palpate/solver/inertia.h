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
  void beginStep(const Points& y, double s, const Eigen::VectorXd& m) {
    y_ = y;
    weights_ = s * m;
  }

  /// On each node at x, 3 x n [N]: minus mass times acceleration.
  void forces(const Points& x, Points* f) const { f->noalias() = (y_ - x) * weights_.asDiagonal(); }

  double value(const Points& x) const override {
    return 0.5 * ((x - y_).colwise().squaredNorm().transpose().cwiseProduct(weights_)).sum();
  }
  double addGradient(const Points& x, Points* g) const override {
    *g += (x - y_) * weights_.asDiagonal();
    return value(x);
  }
  void addHessian(const Points&, fem::Tangent, fem::Stiffness* K) const override {
    fem::BlockMatrix& blocks = K->blocks();
    for (int i = 0; i < blocks.numNodes(); ++i)
      blocks.block(blocks.diagonal(i)).diagonal().array() += weights_[i];
  }

 private:
  Eigen::VectorXd weights_;
  Points y_;
};

}  // namespace palpate::solver
