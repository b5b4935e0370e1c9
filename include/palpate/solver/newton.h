// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/base/thread_pool.h"
#include "palpate/solver/line_search.h"
#include "palpate/solver/linear_solver.h"
#include "palpate/solver/minimizer.h"

namespace palpate::solver {

class KeptStiffness;

/// Newton's method with backtracking [Nocedal, Wright 2006, alg. 3.2].
class Newton final : public Minimizer {
 public:
  /// `A` has the body's pattern. `keep_stiffness`: the elastic part of the tangent is not assembled
  /// again while the body hardly changes its shape and iterations go on well with it. `pool` may be
  /// null and must outlive this.
  Newton(fem::Stiffness A, std::unique_ptr<LinearSolver> linear, bool keep_stiffness = false,
         ThreadPool* pool = nullptr);
  ~Newton() override;

  NewtonReport minimize(const Potential& potential, const NewtonSettings& settings,
                        Points* x) override;
  SolveStatus predict(const Potential& potential, const Points& move, Points* x) override;
  bool tangentStep(const Potential& potential, const Points& x, const Points& push,
                   double linear_tolerance, Points* d, NewtonReport* report) override;
  const Points& gradient() const override { return g_; }
  double roundoffForce(const Points& x) const override;
  LinearSolver* linear() override { return linear_.get(); }
  bool learnsFromRest(bool lasting) const override { return linear_->learnsFromRest(lasting); }
  void learnFromRest(const std::function<void(fem::Stiffness*)>& assemble) override;
  void prepare(const Potential& potential, const Points& x) override;
  void beginCycle(double dt) override;
  void restart() override;
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;
  int waits() const override { return linear_->waits(); }

 private:
  /// d = -A^-1 g on the free components, from the exact tangent if that is positive definite.
  /// Sets `kept_`.
  LinearReport direction(const Potential& potential, const Points& x, double linear_tolerance,
                         const Interrupt* interrupt, NewtonReport* report);

  bool assemble(const Potential& potential, const Points& x, fem::Tangent tangent,
                const Interrupt* interrupt);
  bool servedWell(double residual, double before) const;

  fem::Stiffness A_;
  std::unique_ptr<KeptStiffness> elastic_;  // null: none is kept
  bool kept_ = false;  // in the last matrix: its elastic part is from an earlier x
  std::unique_ptr<LinearSolver> linear_;
  LineSearch line_search_;
  Points g_, d_, right_, x_trial_;
};

}  // namespace palpate::solver
