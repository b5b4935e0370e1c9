// SPDX-License-Identifier: GPL-3.0-or-later
#include "tled_method.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::tissue {
namespace {

constexpr int kMaxRefinement = 2;
// Most sub-steps of a cycle; more cost more than implicit steps.
constexpr double kMaxSubSteps = 2000.0;
// Contact is slow above this number of Newton iterations in a cycle, plus the number per sub-step.
constexpr int kMinContactIterations = 200, kContactIterationsPerSubStep = 10;
// Largest ratio of sub-steps to those at rest [-].
constexpr double kMaxSubStepRatio = 20.0;
// Largest ratio of energy gained to energy supplied [-]; above it energy is spurious.
constexpr double kMaxEnergyRatio = 4.0;

}  // namespace

TledMethod::TledMethod(FemBody* body)
    : body_(*body),
      masses_(body->elasticity->masses()),
      inverse_masses_(body->free * masses_.cwiseInverse().asDiagonal()),
      critical_(body->elasticity.get(), body->free,
                body->surroundings.largestSquare(body->mesh.points, masses_)),
      contact_(body) {
  critical_.begin(body->mesh.points);
  u_ = contact_g_ = inertia_ = held_velocity_ = held_before_ = Points::Zero(3, masses_.size());
}

void TledMethod::restart() {
  refinement_ = 1;
  overran_ = !(body_.elasticity->minJacobian(body_.x) > 0.0);
  budget_ = EnergyBudget();
  contact_.clear();
  contact_g_.setZero();
  inertia_.setZero();
  held_velocity_.setZero();
  forces(std::numeric_limits<double>::infinity());
}

void TledMethod::stop() {
  budget_ = EnergyBudget();
  held_velocity_.setZero();
  contact_g_.setZero();
  inertia_.setZero();
}

void TledMethod::save(StateWriter* out) const {
  for (const Points* p : {&g_, &contact_g_, &inertia_}) out->put(*p);
  out->put(potential_);
  out->put(refinement_);
  out->put(overran_);
  for (double d : {budget_.kinetic, budget_.potential, budget_.least_potential, budget_.work,
                   budget_.cycles}) {
    out->put(d);
  }
  critical_.save(out);
  if (body_.heldMoves()) out->put(held_velocity_);
}

void TledMethod::restore(StateReader* in) {
  contact_.clear();
  for (Points* p : {&g_, &contact_g_, &inertia_}) in->getSame(p);
  in->get(&potential_);
  in->get(&refinement_);
  in->get(&overran_);
  for (double* d : {&budget_.kinetic, &budget_.potential, &budget_.least_potential, &budget_.work,
                    &budget_.cycles}) {
    in->get(d);
  }
  critical_.restore(in);
  if (body_.heldMoves()) in->getSame(&held_velocity_);
}

// Gradient [N] and energy [J] of all forces except contact, at body_.x.
void TledMethod::forces(double h) {
  if (body_.elasticity->viscous()) body_.elasticity->beginStep(h);
  potential_ = body_.elasticity->gradient(body_.x, &g_);
  potential_ += body_.addLoads(body_.x, &g_);
}

double TledMethod::kineticEnergy() const {
  return 0.5 * body_.v.colwise().squaredNorm().dot(masses_.transpose());
}

int TledMethod::subSteps(double dt, TissueStep* out) {
  const PhaseTimer timer(&out->phases, Phase::kForces);
  critical_.follow(body_.x);
  const double stable = std::ceil(dt / (CriticalStep::kSafety * critical_.seconds()));
  const double steps = std::max({1.0, stable, contact_.steps()});
  if (critical_.squeezed() > kMaxSubStepRatio) return 0;
  return steps <= kMaxSubSteps ? static_cast<int>(steps) : 0;
}

bool TledMethod::advance(double dt, TissueStep* out) {
  out->status = solver::SolveStatus::kNonFinite;
  if (!body_.v.allFinite()) return false;
  out->tolerance = body_.tolerance();
  const int steps = subSteps(dt, out);
  if (steps == 0) {
    out->status = solver::SolveStatus::kIterationLimit;
    return false;
  }
  x_begin_ = body_.x;
  v_begin_ = body_.v;
  g_begin_ = g_;
  const double potential_begin = potential_;
  const Points held_begin = held_velocity_;
  const std::unique_ptr<fem::ViscousState> viscous = body_.elasticity->saveViscousState();
  StateWriter touched;
  body_.contact.save(&touched);
  for (refinement_ = std::max(1, refinement_ / 2); refinement_ <= kMaxRefinement;
       refinement_ *= 2) {
    if (run(dt, refinement_ * steps, out)) return true;
    const bool late = solver::isInterrupted(body_.interrupt);
    body_.x = x_begin_;
    body_.v = v_begin_;
    g_ = g_begin_;
    potential_ = potential_begin;
    held_velocity_ = held_begin;
    body_.elasticity->restoreViscousState(viscous.get());
    StateReader before(touched.bytes());
    body_.contact.restore(&before);
    if (late || contact_slow_ || overran_) return false;
    if (energy_grew_ && budget_.isOpen()) return false;  // a rollback covers one cycle only
  }
  refinement_ = kMaxRefinement;
  return false;
}

// Runs all sub-steps of a cycle and checks its energy budget.
bool TledMethod::run(double dt, int steps, TissueStep* out) {
  SubSteps sub_steps{dt / steps, steps};
  EnergyBudget budget = budget_;
  if (!budget.isOpen()) budget = {kineticEnergy(), potential_, potential_, 0.0, 0.0};
  work_ = budget.work;
  out->time_steps = refinement_;
  out->sweep_stages = steps;
  if (!runSubSteps(&sub_steps, out) || !finishCycle(&sub_steps, out)) return false;
  budget.least_potential = std::min(budget.least_potential, potential_);
  energy_grew_ = !plausible(budget);
  if (energy_grew_) return false;
  if (sub_steps.touched) body_.min_jacobian = sub_steps.least_jacobian;
  budget_ = budget;
  budget_.work = work_;
  budget_.cycles =
      sub_steps.late ? budget.cycles + sub_steps.taken / static_cast<double>(steps) : 1.0;
  const double h = sub_steps.h;
  inertia_ =
      -((2.0 / h) * (body_.v - u_) + body_.settings.mass_damping * u_) * masses_.asDiagonal();
  addHeldInertia(h);
  out->residual = contact_.residual();
  body_.contact.learn(body_.x, dt);
  out->status = contact_.status(out->tolerance, sub_steps.late);
  return true;
}

// Runs sub-steps up to a deadline. Returns false on failure.
bool TledMethod::runSubSteps(SubSteps* sub_steps, TissueStep* out) {
  const double h = sub_steps->h, damping = 0.5 * body_.settings.mass_damping * h;
  coefficients_ = (1.0 + damping) / (h * h) * masses_;
  tunnelled_ = contact_slow_ = energy_grew_ = overran_ = false;
  int contact_iterations = 0;
  contact_.begin();
  // Velocity of the half step before, damped.
  u_ = body_.v.cwiseProduct(body_.free) + 0.5 * h * inverse_masses_.cwiseProduct(g_ + contact_g_);
  for (int k = 1; k <= sub_steps->steps && !sub_steps->late; ++k) {
    if (k > 1) u_ *= 1.0 - damping;
    subStep(h, k / static_cast<double>(sub_steps->steps), out);
    if (tunnelled_ || !std::isfinite(potential_)) break;
    sub_steps->taken = k;
    sub_steps->touched = sub_steps->touched || !contact_.nodes().empty();
    contact_iterations += contact_.iterations();
    contact_slow_ = contact_iterations > kMinContactIterations + kContactIterationsPerSubStep * k;
    if (contact_slow_) {
      out->status = solver::SolveStatus::kIterationLimit;
      return false;
    }
    sub_steps->late = k < sub_steps->steps && solver::isInterrupted(body_.interrupt);
  }
  // The tissue has not followed the tools.
  if (sub_steps->late) body_.tool_contact.inside_tools.invalidate();
  out->status =
      tunnelled_ ? solver::SolveStatus::kLineSearchFailed : solver::SolveStatus::kNonFinite;
  return !tunnelled_ && std::isfinite(potential_) && body_.x.allFinite();
}

// Sets velocities at the cycle's end. Returns false where an uncut cycle leaves tissue overrun; the
// next cycle then begins with implicit steps.
bool TledMethod::finishCycle(SubSteps* sub_steps, TissueStep* out) {
  if (sub_steps->touched) sub_steps->least_jacobian = body_.elasticity->minJacobian(body_.x);
  overran_ = (sub_steps->touched && contact_.limited()) || !(sub_steps->least_jacobian > 0.0);
  if (overran_ && !sub_steps->late) {
    out->status = solver::SolveStatus::kLineSearchFailed;
    return false;
  }
  const double h = sub_steps->h, damping = 0.5 * body_.settings.mass_damping * h;
  contact_g_ = contact_.gradient();
  body_.v = (1.0 - damping) * u_ - 0.5 * h * inverse_masses_.cwiseProduct(g_ + contact_g_);
  return body_.v.allFinite();
}

// Computes one sub-step with the tools at fraction `s` of their path; u_ are damped velocities.
void TledMethod::subStep(double h, double s, TissueStep* out) {
  const double damping = 0.5 * body_.settings.mass_damping * h;
  u_ = (u_ - h * inverse_masses_.cwiseProduct(g_)) / (1.0 + damping);
  next_ = h * u_;
  moveHeld(h, s);
  {
    const PhaseTimer timer(&out->phases, Phase::kContact);
    if (!applyContact(h, s)) return;
  }
  const PhaseTimer timer(&out->phases, Phase::kForces);
  body_.x.swap(next_);
  forces(h);
  if (body_.elasticity->viscous()) body_.elasticity->endStep(body_.x);
  body_.contact.endStep(body_.x);
}

// Moves spring anchors and prescribed nodes.
void TledMethod::moveHeld(double h, double s) {
  body_.surroundings.moveTo(s);
  if (!body_.heldMoves()) return;
  body_.heldWay(s, &held_way_);
  held_before_ = held_velocity_;
  held_velocity_ = held_way_ / h;
  work_ += std::abs(held_way_.cwiseProduct(g_).sum());
  work_ += std::abs(
      ((held_velocity_ - held_before_) * masses_.asDiagonal()).cwiseProduct(held_velocity_).sum());
  u_ = u_.cwiseProduct(body_.free) + held_velocity_;
  next_ = next_.cwiseProduct(body_.free) + held_way_;
}

// Adds the inertia force of prescribed nodes, which supports exert.
void TledMethod::addHeldInertia(double h) {
  if (!body_.heldMoves()) return;
  const Points held = 1.0 - body_.free.array();
  inertia_ = inertia_.cwiseProduct(body_.free) -
             held.cwiseProduct((held_velocity_ - held_before_) / h +
                               body_.settings.mass_damping * held_velocity_) *
                 masses_.asDiagonal();
}

// Turns the displacement next_ into next positions, with contact.
bool TledMethod::applyContact(double h, double s) {
  tunnelled_ = !contact_.step(s, coefficients_, &next_);
  if (tunnelled_) return false;
  for (int i : contact_.nodes()) {
    const Vec3 way = next_.col(i) - body_.x.col(i);
    u_.col(i) = way / h;
    work_ += std::abs(way.dot(contact_.gradient().col(i)));
  }
  return true;
}

// Whether kinetic energy comes from kinetic energy, released potential energy, or the tools. Over
// several cut cycles the potential energy must have a source as well.
bool TledMethod::plausible(const EnergyBudget& since) const {
  const double released = std::max(0.0, since.potential - potential_);
  const double noise = 1e-3 * body_.force_floor * contact_.elementSize();
  const double kinetic = kineticEnergy();
  if (kinetic > kMaxEnergyRatio * (since.kinetic + released + work_ + noise)) return false;
  if (since.cycles == 0.0) return true;
  const double given = since.kinetic + (since.potential - since.least_potential) + work_ + noise;
  const double gained = kinetic + potential_ - since.kinetic - since.potential;
  return gained <= kMaxEnergyRatio * given;
}

double TledMethod::unbalancedForce() { return (g_ + contact_g_).cwiseProduct(body_.free).norm(); }

void TledMethod::reportForces(TissueStep* out) {
  out->inertia_force = inertia_.rowwise().sum();
  next_ = g_ + contact_g_;
  if (body_.heldMoves()) next_ -= inertia_;  // held components only
  body_.reportSupport(next_, out);
  body_.reportContacts(out);
}

}  // namespace palpate::tissue
