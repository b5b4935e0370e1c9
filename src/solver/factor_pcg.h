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
  /// What an iteration with A takes [s], by unit_costs.h.
  static double iterationSeconds(const fem::Stiffness& A, const StaleFactor& factor);

  /// A x = b as by a LinearSolver, in at most `most` iterations: at these `in_vain`, and `x` is a
  /// direction of descent. `factor` must be ready; it is scaled to A. kNotPositiveDefinite: A is
  /// not, but for rounding.
  LinearReport solve(const fem::Stiffness& A, const Points& b, double relative_tolerance, int most,
                     const Interrupt* interrupt, StaleFactor* factor, Points* x);

 private:
  std::vector<Mat3> diagonal_;
  Points r_, z_, p_, Ap_;
};

}  // namespace palpate::solver
