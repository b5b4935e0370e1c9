// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "moving_bodies.h"
#include "palpate/solver/minimizer.h"

namespace palpate::tissue {

/// Implicit steps of bodies that move as one: each minimises the incremental potential (inertia,
/// elasticity, loads, contact, interactions) with a minimiser. A cycle whose solve fails is
/// rejected and tried again in 2, 4, 8 ... shorter steps. A cycle of a scene has so many iterations
/// as five solves may take, one and a half more for each trial, and four for each stage of the
/// tools' way; where they are used up it ends with the best state so far.
class ImplicitSteps {
 public:
  /// `bodies` must outlive this.
  ImplicitSteps(MovingBodies* bodies, std::unique_ptr<solver::Minimizer> minimizer)
      : bodies_(*bodies), minimizer_(std::move(minimizer)) {}

  solver::Minimizer& minimizer() { return *minimizer_; }
  /// As StepMethod::advance().
  bool advance(double dt, TissueStep* out);
  /// Forgets what the minimiser learnt.
  void forget() {
    prepared_ = false;
    minimizer_->restart();
  }
  /// Of the potential where the last step ended, 3 x n [N].
  const Points& gradient() const { return minimizer_->gradient(); }

  void save(StateWriter* out) const;
  void restore(StateReader* in);

 private:
  bool timeStep(double begin, double end, double h);
  void startFromPredictor(double begin, double end, double h);
  void solveStages(double begin, double end);
  bool settled();
  void settle();
  bool startGuarding();
  void followTools(double from, double to, const Points& x);
  void add(const solver::NewtonReport& report);
  solver::SolveStatus moveHeld(double s, double end);
  solver::NewtonReport solveStage(bool on_the_way);
  int iterationsLeft() const;
  bool acceptable();

  MovingBodies& bodies_;
  std::unique_ptr<solver::Minimizer> minimizer_;
  bool prepared_ = false;  // since the last restart
  // Of the cycle under way: trials that failed, stages of the tools' way.
  int trials_ = 0, stages_ = 0;

  Points begin_x_, predicted_, gradient_there_, push_, way_;
  TissueStep* out_ = nullptr;  // of the cycle under way
};

}  // namespace palpate::tissue
