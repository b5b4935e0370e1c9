// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "implicit_steps.h"
#include "tissue/body/step_method.h"

namespace palpate::tissue {

/// ImplicitSteps of one body, for scenes and for cases of `palpate solve`.
class ImplicitMethod final : public StepMethod {
 public:
  ImplicitMethod(FemBody* body, std::unique_ptr<solver::Minimizer> minimizer);

  bool advance(double dt, TissueStep* out) override { return steps_.advance(dt, out); }
  void reportForces(TissueStep* out) override { motion_.reportForces(steps_.gradient(), out); }
  double unbalancedForce() override { return bodies_.unbalancedForce(steps_.gradient()); }
  const Eigen::VectorXd& masses() const override { return motion_.masses(); }
  BodyMotion* motion() override { return &motion_; }
  void prepare(double dt) override { steps_.prepare(dt); }
  void forget() override { steps_.forget(); }
  void restart() override;
  void goOnFrom(const StepMethod& old, const mesh::MeshChange& change) override;
  void stop() override { motion_.stop(); }
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;

 private:
  BodyMotion motion_;
  StepGroup bodies_;
  ImplicitSteps steps_;
};

}  // namespace palpate::tissue
