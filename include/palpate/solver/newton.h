// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/phase_times.h"
#include "palpate/solver/linear_solver.h"
#include "palpate/solver/potential.h"

namespace palpate::solver {

struct NewtonSettings {
  double tolerance = 0.0;  ///< Absolute [N], on the norm of the free gradient.
  int max_iterations = 20;
  double linear_tolerance = 1e-2;  ///< Relative, of the linear solves; tighter for the last.
};

struct NewtonReport {
  SolveStatus status = SolveStatus::kConverged;
  int iterations = 0;  ///< Steps taken.
  int linear_iterations = 0;
  int projections = 0;    ///< Linear systems that had to be made positive definite.
  double residual = 0.0;  ///< Norm of the free gradient at the end [N].
  PhaseTimes phases;
};

/// Minimises a potential by Newton's method with backtracking (Armijo's rule on the value)
/// [Nocedal, Wright 2006, alg. 3.2]; where the potential has non-conservative terms, on the
/// residual instead. Keeps its scratch memory between calls.
class Newton {
 public:
  /// `A` has the body's pattern.
  explicit Newton(const fem::Stiffness& A) : A_(A) {}

  /// Improves x, 3 x n, whose held components stay. x is never worse than it was and always finite.
  NewtonReport minimize(const Potential& potential, const NewtonSettings& settings,
                        LinearSolver* linear, Points* x);

  /// Moves the held components by `move` (3 x n, zero where free) and the free ones as the tangent
  /// at x says, a good first guess for the next load step. x is untouched if the solve fails.
  SolveStatus predict(const Potential& potential, const Points& move, LinearSolver* linear,
                      Points* x);

  /// All components of the gradient where the last minimize() ended; on held ones it is the force
  /// that the support exerts on the body.
  const Points& gradient() const { return g_; }

  /// Norm of the force that rounding alone makes at x, with the last matrix assembled [N]: no
  /// residual gets below it.
  double roundoffForce(const Points& x) const;

 private:
  /// d = -A^-1 g on the free components, from the exact tangent if that is positive definite.
  LinearReport direction(const Potential& potential, const Points& x, double linear_tolerance,
                         LinearSolver* linear, NewtonReport* report);
  bool lineSearch(const Potential& potential, double value, Points* x, double* next_value,
                  NewtonReport* report);

  fem::Stiffness A_;
  Points g_, d_, right_, x_trial_, g_trial_;
};

}  // namespace palpate::solver
