// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/solver/linear_solver.h"

namespace palpate::solver {

class CholmodFactor;

/// Solves with a stiffness with volumes, K = K_dist + B^T W B, by the Cholesky factor of K_dist and
/// by conjugate gradients for the pressures p = W B x [Benzi, Golub, Liesen 2005, sec. 5]. K_dist
/// couples one ring of elements, K two.
///
///   (W^-1 + B K_dist^-1 B^T) p = B K_dist^-1 b,   x = K_dist^-1 (b - B^T p),
///
/// The preconditioner is the diagonal of W^-1 + B D^-1 B^T, D the diagonal blocks of K_dist. The
/// number of iterations hardly depends on the mesh or on incompressibility.
class PressureSystem {
 public:
  PressureSystem();
  ~PressureSystem();

  /// Sets K without factorising; returns the estimated number of iterations of a solve.
  double prepare(const fem::Stiffness& K);
  /// Symbolic analysis of K_dist, for the costs of factorize() and of an iteration.
  const CholmodFactor& analyze(const fem::Stiffness& K);
  /// @pre prepare(K) was called. kNotPositiveDefinite: K_dist is not; K may be.
  SolveStatus factorize(const fem::Stiffness& K);
  /// Solves to |b - K x| <= `relative_tolerance` |b|, with the stiffness of the last factorize().
  LinearReport solve(const fem::Stiffness& K, const Points& b, double relative_tolerance,
                     Points* x);

 private:
  double residual(const fem::VolumeStiffness& volume, const Eigen::VectorXd& r);

  std::unique_ptr<CholmodFactor> factor_;
  std::vector<Mat3> diagonal_;
  Eigen::VectorXd preconditioner_;
  Eigen::VectorXd r_, z_, d_, Sd_, c_;
  Points f_, t_;
};

}  // namespace palpate::solver
