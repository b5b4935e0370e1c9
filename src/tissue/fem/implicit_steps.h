// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "cycle_budget.h"
#include "palpate/solver/minimizer.h"
#include "step_group.h"

namespace palpate::tissue {

/// Implicit steps of bodies that move as one: each minimises the incremental potential (inertia,
/// elasticity, loads, contact, interactions) with a minimiser. A cycle whose solve fails is
/// rejected and tried again in 2, 4, 8 ... shorter steps, at once in the shortest where it used up
/// the CycleBudget. Where that is used up the cycle ends with the best state so far.
class ImplicitSteps {
 public:
  /// `bodies` must outlive this.
  ImplicitSteps(StepGroup* bodies, std::unique_ptr<solver::Minimizer> minimizer)
      : bodies_(*bodies),
        minimizer_(std::move(minimizer)),
        budget_(bodies->settings(), minimizer_->iterationsForOne()) {}

  solver::Minimizer& minimizer() { return *minimizer_; }
  /// As StepMethod::advance().
  bool advance(double dt, TissueStep* out);
  /// As StepMethod::prepare().
  void prepare(double dt);
  /// Forgets what the minimiser learnt, and the last cycle.
  void forget() {
    forgetLearnt();
    forgetCycle();
  }
  /// The bodies did not come to where they are by the last cycle.
  void forgetCycle() { stalled_ = false; }
  /// Of the potential where the last step ended, 3 x n [N].
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
  bool prepared_ = false;  // since the last restart
  bool stalled_ = false;   // the last cycle was late, and led nowhere
  int iterations_ = 0;     // of the minimiser in the cycle, without those that followed tools
  CycleBudget budget_;

  Points begin_x_, predicted_, gradient_there_, push_, way_;
  TissueStep* out_ = nullptr;  // of the cycle under way
};

}  // namespace palpate::tissue
