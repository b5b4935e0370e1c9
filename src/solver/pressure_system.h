// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/solver/linear_solver.h"

namespace palpate::solver {

class CholmodFactor;

/// Solves with a stiffness that has volumes, K = K_dist + B^T W B, by the Cholesky factor of
/// K_dist, whose pattern reaches over one ring of elements where K's reaches over two, and by
/// conjugate gradients for the pressures p = W B x [Benzi, Golub, Liesen 2005, sec. 5]:
///
///   (W^-1 + B K_dist^-1 B^T) p = B K_dist^-1 b,   x = K_dist^-1 (b - B^T p),
///
/// preconditioned by the diagonal of W^-1 + B D^-1 B^T, D the diagonal blocks of K_dist: their
/// number hardly depends on the mesh, nor on how incompressible the body is.
class PressureSystem {
 public:
  PressureSystem();
  ~PressureSystem();

  /// Takes K, without the factor; returns about how many iterations a solve will take.
  double prepare(const fem::Stiffness& K);
  /// Symbolic analysis of K_dist: what factorize() and each iteration will cost.
  const CholmodFactor& analyze(const fem::Stiffness& K);
  /// After prepare(). kNotPositiveDefinite: K_dist is not, which says nothing of K.
  SolveStatus factorize(const fem::Stiffness& K);
  /// To |b - K x| <= `relative_tolerance` |b|, with the stiffness of the last factorize().
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
