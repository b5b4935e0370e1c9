// SPDX-License-Identifier: GPL-3.0-or-later
#include "hybrid_steps.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/solver/minimizer_list.h"
#include "tissue/methods/method_list.h"

namespace palpate::tissue {
namespace {

std::unique_ptr<StepMethod> implicitSteps(FemBody* body) {
  const std::vector<std::string> names = solver::minimizerNames();
  const std::string& name = body->settings.method;
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    throw std::invalid_argument("method = " + name + ": model hybrid takes one of " +
                                joinNames(names));
  }
  if (body->settings.stiffness_damping != 0.0) {
    throw std::invalid_argument(
        "damping.stiffness = " + std::to_string(body->settings.stiffness_damping) +
        ": model hybrid damps in proportion to mass only; leave it out");
  }
  return makeStepMethod(name, body);
}

}  // namespace

HybridSteps::HybridSteps(FemBody* body, HybridElasticity* elasticity, bool loop)
    : body_(*body), elasticity_(*elasticity), loop_(loop) {
  elasticity->follow(&body->contact);
  body->drive.loads.push_back(elasticity->couplings());
  body->guard.keepOnly(elasticity->region());
  steps_ = implicitSteps(body);
  body->method = "hybrid";
  // Points of the surface do not go on as they did: those that are no unknowns stay where they are
  // put, the others have no inertia.
  if (!elasticity->rest()) return;
  for (const int i : elasticity->rest()->surface()) body->free.col(i).setZero();
}

void HybridSteps::moveToEquilibrium(Points* x) {
  elasticity_.recoverUntouched(x);
  if (loop_) elasticity_.beginLoop(*x);
}

// What was put elsewhere goes where it is in balance.
void HybridSteps::restart() {
  elasticity_.recoverUntouched(&body_.x);
  steps_->restart();
}

bool HybridSteps::advance(double dt, TissueStep* out) {
  begin_x_ = body_.x;
  elasticity_.beginCycle(body_.x);
  if (!steps_->advance(dt, out)) {
    body_.x = begin_x_;
    return false;
  }
  const PhaseTimer timer(&out->phases, Phase::kForces);
  elasticity_.recover(&body_.x);
  if (!elasticity_.rest()) return true;
  for (const std::vector<int>* put :
       {&elasticity_.rest()->surface(), &elasticity_.rest()->inner()}) {
    for (const int i : *put) body_.v.col(i) = (body_.x.col(i) - begin_x_.col(i)) / dt;
  }
  return true;
}

void HybridSteps::reportForces(TissueStep* out) {
  steps_->reportForces(out);
  if (!elasticity_.rest()) return;
  elasticity_.reactions(&reactions_);
  const std::vector<int>& fixed = elasticity_.rest()->fixed();
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    body_.support_forces.col(fixed[k]) += reactions_.col(static_cast<Eigen::Index>(k));
  }
  out->support_force += reactions_.rowwise().sum();
  body_.support_force = body_.support_forces.norm();
}

}  // namespace palpate::tissue
