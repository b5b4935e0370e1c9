// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/fem/fem_dynamics.h"

#include "tissue/body/fem_body.h"
#include "tissue/body/step_method.h"
#include "tissue/methods/method_list.h"

namespace palpate::tissue {

struct FemDynamics::Impl {
  FemBody body;
  std::unique_ptr<StepMethod> method;
  TissueStep out;
};

FemDynamics::FemDynamics(const mesh::TetMesh& mesh, const fem::Composition& composition,
                         const fem::FreeMask& free, const FemSettings& settings,
                         std::shared_ptr<fem::Elasticity> elasticity, Drive drive, ThreadPool* pool)
    : impl_(new Impl{
          {mesh, composition, free, settings, pool, std::move(drive), std::move(elasticity)},
          nullptr,
          {}}) {
  FemBody& body = impl_->body;
  impl_->method = makeStepMethod(settings.method, &body);
  body.elasticity->relax(body.x);
  impl_->method->restart();
}

FemDynamics::~FemDynamics() = default;

bool FemDynamics::advance(double dt) {
  FemBody& body = impl_->body;
  TissueStep& out = impl_->out;
  out.clear();
  body.tool_contact.begin({}, body.x, body.v, dt, &out);
  if (!impl_->method->advance(dt, &out)) return false;
  impl_->method->reportForces(&out);
  return true;
}

const TissueStep& FemDynamics::report() const { return impl_->out; }
const Points& FemDynamics::positions() const { return impl_->body.x; }
const Points& FemDynamics::supportForces() const { return impl_->body.support_forces; }

double FemDynamics::elasticEnergy() const {
  const std::optional<double> own = impl_->method->elasticEnergy();
  return own ? *own : impl_->body.elasticity->energy(impl_->body.x);
}

std::vector<std::string> FemDynamics::notes() const {
  if (impl_->body.method_note.empty()) return {};
  return {impl_->body.method_note};
}

}  // namespace palpate::tissue
