// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/fem/stiffness.h"
#include "palpate/solver/status.h"

namespace palpate::solver {

struct LinearReport {
  SolveStatus status = SolveStatus::kConverged;
  int iterations = 0;  ///< Zero for a direct solver.
};

/// Solves A x = b, A symmetric positive definite with a pattern that is always the same.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// `b` and `x` are 3 x n; `x` is overwritten. An iterative solver stops when |b - A x| <=
  /// `relative_tolerance` |b|. kNotPositiveDefinite: A is not, and `x` is of no use;
  /// kIterationLimit: `x` is the best so far, still a direction of descent.
  virtual LinearReport solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                             Points* x) = 0;

  /// The next cycle begins: the only time at which work that was done beside is taken into use.
  virtual void beginCycle() {}
  /// Forgets what it learnt from earlier systems: from here on it does what a new one would.
  virtual void restart() {}
};

}  // namespace palpate::solver
