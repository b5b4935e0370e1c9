// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tissue/body/step_method.h"
#include "tissue/methods/implicit/implicit_method.h"
#include "tled_method.h"

namespace palpate::tissue {

/// Method `tled` of a scene: TledMethod, with a switch to `implicit_pcg` in a cycle where it fails
/// (TledMethod), in the next cycle where a cut one was overrun, or after positions were set with
/// inverted elements. Implicit steps last until the body rests or positions are set.
class TledOrImplicit final : public StepMethod {
 public:
  TledOrImplicit(FemBody* body, std::unique_ptr<solver::Minimizer> minimizer);

  bool advance(double dt, TissueStep* out) override;
  void reportForces(TissueStep* out) override { now().reportForces(out); }
  double unbalancedForce() override { return now().unbalancedForce(); }
  const Eigen::VectorXd& masses() const override { return explicit_.masses(); }
  void forget() override { now().forget(); }
  void restart() override;
  void stop() override;
  void save(StateWriter* out) const override;
  void restore(StateReader* in) override;

 private:
  void switchToImplicit();
  StepMethod& now() {
    return implicit_active_ ? static_cast<StepMethod&>(implicit_)
                            : static_cast<StepMethod&>(explicit_);
  }

  FemBody& body_;
  TledMethod explicit_;
  ImplicitMethod implicit_;
  bool implicit_active_ = false;  // implicit steps are in use
  bool failed_ = false;           // both failed in the last cycle
};

}  // namespace palpate::tissue
