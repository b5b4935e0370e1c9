// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_motion.h"

#include "palpate/solver/line_search.h"

namespace palpate::tissue {

BodyMotion::BodyMotion(FemBody* body)
    : body_(*body),
      integrator_(body->settings.integrator, body->elasticity->masses(),
                  {body->settings.mass_damping, body->settings.stiffness_damping}),
      begin_(integrator_),
      potential_{body->elasticity.get(),
                 {&body->gravity, &body->contact, &body->tool_contact.needles, &body->guard},
                 body->free} {
  integrator_.addTerms(&potential_);
  for (const fem::EnergyTerm* load : body->drive.loads) potential_.terms.push_back(load);
  for (const fem::EnergyTerm* t : body->surroundings.terms()) potential_.terms.push_back(t);
}

void BodyMotion::restart() {
  integrator_.start(body_.x, body_.v);
  if (!integrator_.needsElasticGradient()) return;
  body_.elasticity->gradient(body_.x, &elastic_gradient_);
  Points all = elastic_gradient_;
  body_.addLoads(body_.x, &all);
  const double unbalanced = solver::freeNorm(all, body_.free);
  const bool rests = unbalanced <= body_.leastTolerance();
  integrator_.setElasticGradient(elastic_gradient_, rests ? 0.0 : unbalanced);
}

void BodyMotion::goOnFrom(const BodyMotion& old, const mesh::MeshChange& change) {
  restart();
  const auto carry = [&](const Points& p) { return change.interpolate(p); };
  const auto gradient = [&](const Points& x) {
    body_.elasticity->gradient(x, &elastic_gradient_);
    return elastic_gradient_;
  };
  integrator_.goOnFrom(old.integrator_, body_.surroundings.movable(body_.free), carry, gradient);
}

void BodyMotion::beginCycle() {
  begin_ = integrator_;
  viscous_ = body_.elasticity->saveViscousState();
}

void BodyMotion::goBack() {
  integrator_ = begin_;
  body_.moveTo(begin_.positions(), begin_.velocities());
  body_.elasticity->restoreViscousState(viscous_.get());
}

void BodyMotion::endCycle() {
  body_.v = integrator_.velocities();
  viscous_.reset();
}

void BodyMotion::beginStep(double begin, double h) {
  integrator_.beginStep(h, &potential_);
  body_.elasticity->beginStep(h);
  body_.surroundings.moveTo(begin);
  body_.surroundings.beginStep(h, body_.x);
}

void BodyMotion::endStep(double unbalanced) {
  if (integrator_.needsElasticGradient()) body_.elasticity->gradient(body_.x, &elastic_gradient_);
  integrator_.endStep(body_.x, elastic_gradient_, unbalanced);
  body_.elasticity->endStep(body_.x);
}

// Held components contain only rounding errors, which would grow.
void BodyMotion::extrapolate(double h, Points* way) const {
  integrator_.extrapolate(h, way);
  *way = way->cwiseProduct(body_.free);
}

double BodyMotion::valueHere() {
  if (!body_.elastic_energy) return potential_.value(body_.x);
  double sum = potential_.elastic_scale * *body_.elastic_energy;
  for (const fem::EnergyTerm* term : potential_.terms) sum += term->value(body_.x);
  body_.elastic_energy.reset();  // x changes
  return sum;
}

double BodyMotion::squaredUnbalancedForce(const Points& gradient) {
  integrator_.inertiaForces(body_.x, &inertia_forces_);
  return (gradient + inertia_forces_).cwiseProduct(body_.free).squaredNorm();
}

void BodyMotion::reportForces(const Points& gradient, TissueStep* out) {
  integrator_.inertiaForces(body_.x, &inertia_forces_);
  out->inertia_force = inertia_forces_.rowwise().sum();
  body_.reportSupport(gradient, out);
  body_.reportContacts(out);
}

}  // namespace palpate::tissue
