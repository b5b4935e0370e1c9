// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "implicit_method.h"
#include "step_method.h"
#include "tled_method.h"

namespace palpate::tissue {

/// Method `tled` of a scene: TledMethod, and implicit steps by `implicit_pcg`, which go on in the
/// same cycle where it fails: it made energy, left what is finite, lost a tool, labours in contact,
/// or would need many times the sub-steps that it needs at rest, or thousands; where a tool overran
/// tissue, in the next one if this was cut; or from where it was placed inverted. They go on until
/// the body has come to rest or was placed anew.
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
  bool implicit_active_ = false;  // implicit steps go on
  bool failed_ = false;           // in the last cycle, implicit steps too
};

}  // namespace palpate::tissue
