// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "hybrid_elasticity.h"
#include "tissue/body/step_method.h"

namespace palpate::tissue {

/// Implicit steps of a body of HybridElasticity by the scene's method. Each cycle ends with
/// recover(); in a loop it begins with the exchange of forces and displacements. Not for groups.
class HybridSteps final : public StepMethod {
 public:
  /// `elasticity`: the body's. @throws std::invalid_argument for a method that is not implicit, and
  /// for stiffness damping, which the linear part does not support.
  HybridSteps(FemBody* body, HybridElasticity* elasticity, bool loop);

  bool advance(double dt, TissueStep* out) override;
  void reportForces(TissueStep* out) override;
  double unbalancedForce() override { return steps_->unbalancedForce(); }
  const Eigen::VectorXd& masses() const override { return steps_->masses(); }
  void moveToEquilibrium(Points* x) override;
  void restart() override;
  void stop() override { steps_->stop(); }
  void save(StateWriter* out) const override { steps_->save(out); }
  void restore(StateReader* in) override { steps_->restore(in); }

 private:
  FemBody& body_;
  HybridElasticity& elasticity_;
  bool loop_;
  std::unique_ptr<StepMethod> steps_;
  Points begin_x_, reactions_;
};

}  // namespace palpate::tissue
