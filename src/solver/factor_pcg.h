// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/solver/linear_solver.h"
#include "stale_factor.h"

namespace palpate::solver {

/// Conjugate gradients preconditioned by the Cholesky factor of an earlier matrix
/// [Courtecuisse et al. 2014, sec. 4].
class FactorPcg {
 public:
  /// Estimated time of an iteration with A [s], by unit_costs.h.
  static double iterationSeconds(const fem::Stiffness& A, const StaleFactor& factor);

  /// Solves A x = b as LinearSolver, in at most `most` iterations; then `in_vain` is set, and `x`
  /// is a descent direction. @pre `factor` is ready; it is scaled to A. kNotPositiveDefinite: A is
  /// not, up to rounding.
  LinearReport solve(const fem::Stiffness& A, const Points& b, double relative_tolerance, int most,
                     const Interrupt* interrupt, StaleFactor* factor, Points* x);

 private:
  std::vector<Mat3> diagonal_;
  Points r_, z_, p_, Ap_;
};

}  // namespace palpate::solver
