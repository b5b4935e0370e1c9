// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/fem/energy_term.h"

namespace palpate::solver {

/// Inertia of an implicit step as an energy, 1/2 sum_i m_i/h^2 |x_i - y_i|^2, with y the positions
/// that the masses would reach if nothing held them [Hairer, Lubich, Wanner 2006, sec. VI.6 on
/// variational integrators; the incremental potential of Kane et al. 2000]. Backward Euler:
/// y = x_n + h v_n, and v_{n+1} = (x_{n+1} - x_n) / h.
class Inertia final : public fem::EnergyTerm {
 public:
  explicit Inertia(Eigen::VectorXd masses) : masses_(std::move(masses)) {}

  /// Lumped masses, n [kg].
  const Eigen::VectorXd& masses() const { return masses_; }

  /// Begins a step of `h` [s] towards y, 3 x n [m].
  void beginStep(const Points& y, double h) {
    y_ = y;
    weights_ = masses_ / (h * h);
  }

  double value(const Points& x) const override {
    return 0.5 * ((x - y_).colwise().squaredNorm().transpose().cwiseProduct(weights_)).sum();
  }
  double addGradient(const Points& x, Points* g) const override {
    *g += (x - y_) * weights_.asDiagonal();
    return value(x);
  }
  void addHessian(const Points&, fem::Tangent, fem::BlockMatrix* K) const override {
    for (int i = 0; i < K->numNodes(); ++i)
      K->block(K->diagonal(i)).diagonal().array() += weights_[i];
  }

 private:
  Eigen::VectorXd masses_, weights_;
  Points y_;
};

}  // namespace palpate::solver
