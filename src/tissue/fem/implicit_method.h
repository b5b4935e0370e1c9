// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "palpate/solver/integrator.h"
#include "palpate/solver/minimizer.h"
#include "step_method.h"

namespace palpate::tissue {

/// Implicit steps: each minimises the incremental potential (inertia, elasticity, loads, contact)
/// with a minimiser. A cycle whose solve fails is rejected and tried again in 2, 4, 8 ... shorter
/// steps. Scenes and cases of `palpate solve` are stepped by it alike.
class ImplicitMethod final : public StepMethod {
 public:
  ImplicitMethod(FemBody* body, std::unique_ptr<solver::Minimizer> minimizer);

  bool advance(double dt, TissueStep* out) override;
  void reportForces(TissueStep* out) override;
  double unbalancedForce() override;
  const Eigen::VectorXd& masses() const override { return integrator_.masses(); }
  void restart() override;
  void goOnFrom(const StepMethod& old, const mesh::MeshChange& change) override;
  void stop() override { integrator_.stop(); }
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;

 private:
  bool timeStep(double begin, double end, double h);
  void startFromPredictor(double s, double h);
  double valueHere();
  void solveStages(double begin, double end);
  void followTools(double from, double to, const Points& x);
  void add(const solver::NewtonReport& report);
  solver::SolveStatus moveHeld(double s);
  solver::NewtonReport solveStage(bool on_the_way);
  bool settled();
  bool acceptable() const;

  FemBody& body_;
  solver::Integrator integrator_, begin_;  // of the step, of the cycle
  solver::Potential potential_;
  std::unique_ptr<solver::Minimizer> minimizer_;
  bool prepared_ = false;  // since the last restart
  double step_ = 0.0;      // under way [s]

  StateWriter touched_;  // by contact, when the cycle began
  Points begin_x_, elastic_gradient_, inertia_forces_, predicted_, gradient_there_, push_, way_;
  TissueStep* out_ = nullptr;  // of the cycle under way
};

}  // namespace palpate::tissue
