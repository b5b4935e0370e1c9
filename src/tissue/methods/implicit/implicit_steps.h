// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "cycle_budget.h"
#include "palpate/solver/minimizer.h"
#include "step_group.h"

namespace palpate::tissue {

/// Implicit steps of a StepGroup: each minimises the incremental potential of inertia, elasticity,
/// loads, contact and interactions. A failed attempt is rolled back and repeated in 2, 4, 8 ...
/// steps, or at once in the most steps where it used up the CycleBudget. Without budget the cycle
/// ends with the best state.
class ImplicitSteps {
 public:
  /// @pre `bodies` outlives this.
  ImplicitSteps(StepGroup* bodies, std::unique_ptr<solver::Minimizer> minimizer)
      : bodies_(*bodies),
        minimizer_(std::move(minimizer)),
        budget_(bodies->settings(), minimizer_->iterationsForOne()) {}

  solver::Minimizer& minimizer() { return *minimizer_; }
  /// As StepMethod::advance().
  bool advance(double dt, TissueStep* out);
  /// As StepMethod::prepare().
  void prepare(double dt);
  /// Drops the cached solver state and that of the last cycle.
  void forget() {
    forgetLearnt();
    forgetCycle();
  }
  /// Drops the state of the last cycle: positions were set since.
  void forgetCycle() { stalled_ = false; }
  /// Gradient of the potential at the end of the last step, 3 x n [N].
  const Points& gradient() const { return minimizer_->gradient(); }

  void save(StateWriter* out) const;
  void restore(StateReader* in);

 private:
  void forgetLearnt() {
    prepared_ = false;
    minimizer_->restart();
  }
  void prepareHere();
  bool timeStep(double begin, double end, double h);
  void startFromPredictor(double begin, double end, double h);
  void solveStages(double begin, double end);
  bool augmentationConverged();
  void augment();
  bool toleranceIsStale(double residual);
  bool startGuarding();
  bool followTools(double from, double to, const Points& x, bool in_time);
  void add(const solver::NewtonReport& report);
  solver::SolveStatus moveHeld(double s, double end);
  solver::NewtonReport solveStage(bool on_the_way, bool followed = false);
  bool acceptable();

  StepGroup& bodies_;
  std::unique_ptr<solver::Minimizer> minimizer_;
  bool prepared_ = false;  // whether the minimiser is prepared since the last restart
  bool stalled_ = false;   // whether the last cycle hit its deadline without progress
  int iterations_ = 0;     // of the minimiser in the cycle, without those of followTools()
  CycleBudget budget_;

  Points begin_x_, predicted_, gradient_there_, push_, way_;
  TissueStep* out_ = nullptr;  // result of the present cycle
};

}  // namespace palpate::tissue
