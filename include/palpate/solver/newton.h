// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/solver/line_search.h"
#include "palpate/solver/linear_solver.h"
#include "palpate/solver/minimizer.h"

namespace palpate::solver {

/// Newton's method with backtracking [Nocedal, Wright 2006, alg. 3.2].
class Newton final : public Minimizer {
 public:
  /// `A` has the body's pattern.
  Newton(const fem::Stiffness& A, std::unique_ptr<LinearSolver> linear)
      : A_(A), linear_(std::move(linear)) {}

  NewtonReport minimize(const Potential& potential, const NewtonSettings& settings,
                        Points* x) override;
  SolveStatus predict(const Potential& potential, const Points& move, Points* x) override;
  const Points& gradient() const override { return g_; }
  double roundoffForce(const Points& x) const override;
  void prepare(const Potential& potential, const Points& x) override;
  void beginCycle(double dt) override { linear_->beginCycle(dt); }
  void restart() override { linear_->restart(); }
  int waits() const override { return linear_->waits(); }

 private:
  /// d = -A^-1 g on the free components, from the exact tangent if that is positive definite.
  LinearReport direction(const Potential& potential, const Points& x, double linear_tolerance,
                         NewtonReport* report);

  fem::Stiffness A_;
  std::unique_ptr<LinearSolver> linear_;
  LineSearch line_search_;
  Points g_, d_, right_, x_trial_;
};

/// The system A d = right of Minimizer::predict(), A the projected tangent at x, and the gradient g
/// there. False if that is not finite.
bool tangentSystem(const Potential& potential, const Points& x, const Points& move,
                   fem::Stiffness* A, Points* g, Points* right);

/// Norm of the force that rounding alone makes at x with the stiffness A [N].
double roundoffForce(const fem::Stiffness& A, const Points& x);

}  // namespace palpate::solver
