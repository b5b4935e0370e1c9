// SPDX-License-Identifier: GPL-3.0-or-later
#include "implicit_method.h"

#include <algorithm>

#include "palpate/solver/line_search.h"
#include "rest_matrix.h"

namespace palpate::tissue {
namespace {

// Stages before the last one need not be solved as well.
constexpr double kStageTolerance = 100.0;
constexpr int kStageIterations = 4;
// Candidates for contact are searched this many times before a cycle is given up.
constexpr int kMaxSearches = 4;
// Solutions in a step that contact asks for after the first.
constexpr int kMaxSettlings = 3;
// Unbalanced forces of less than this many tolerances Newton's method finds its way out of in one
// step or two.
constexpr double kWorthFollowing = 100.0;
constexpr double kFollowTolerance = 0.01;  // of the linear solve: better does not pay

}  // namespace

ImplicitMethod::ImplicitMethod(FemBody* body, std::unique_ptr<solver::Minimizer> minimizer)
    : body_(*body),
      integrator_(body->settings.integrator, body->elasticity->masses(),
                  {body->settings.mass_damping, body->settings.stiffness_damping}),
      begin_(integrator_),
      potential_{body->elasticity.get(), {&body->gravity, &body->contact}, body->free},
      minimizer_(std::move(minimizer)) {
  integrator_.addTerms(&potential_);
  for (const fem::EnergyTerm* load : body->drive.loads) potential_.terms.push_back(load);
  if (!minimizer_->learnsFromRest(body->settings.lasting)) return;
  minimizer_->learnFromRest([&](fem::Stiffness* A) { assembleAtRest(body, A); });
}

void ImplicitMethod::restart() {
  prepared_ = false;
  minimizer_->restart();
  integrator_.start(body_.x, body_.v);
  if (integrator_.needsElasticGradient()) {
    body_.elasticity->gradient(body_.x, &elastic_gradient_);
    integrator_.setElasticGradient(elastic_gradient_);
  }
}

void ImplicitMethod::goOnFrom(const StepMethod& old, const mesh::MeshChange& change) {
  restart();
  const auto& before = dynamic_cast<const ImplicitMethod&>(old).integrator_;
  integrator_.goOnFrom(before, body_.free, [&](const Points& p) { return change.interpolate(p); });
}

void ImplicitMethod::save(StateWriter* out) const {
  out->put(prepared_);
  integrator_.save(out);
  minimizer_->save(out);
}

void ImplicitMethod::restore(StateReader* in) {
  in->get(&prepared_);
  integrator_.restore(in);
  minimizer_->restore(in);
}

// The cycle in one step, or, where that fails, in more and shorter ones.
bool ImplicitMethod::advance(double dt, TissueStep* out) {
  out_ = out;
  const int waits = minimizer_->waits();
  {
    const PhaseTimer timer(&out_->phases, Phase::kLinearSolve);
    minimizer_->beginCycle(dt);
  }
  out_->factor_waits = minimizer_->waits() - waits;
  begin_ = integrator_;
  const std::unique_ptr<fem::ViscousState> viscous = body_.elasticity->saveViscousState();
  touched_.clear();
  body_.contact.save(&touched_);
  for (int steps = 1; steps <= body_.settings.max_time_steps; steps *= 2) {
    out_->time_steps = steps;
    out_->sweep_stages = 0;
    int done = 0;
    while (done < steps && timeStep(done / double(steps), (done + 1) / double(steps), dt / steps)) {
      ++done;
    }
    body_.v = integrator_.velocities();
    if (done == steps) return true;
    integrator_ = begin_;
    body_.x = begin_.positions();
    body_.elastic_energy.reset();
    body_.v = begin_.velocities();
    body_.elasticity->restoreViscousState(viscous.get());
    StateReader before(touched_.bytes());
    body_.contact.restore(&before);
  }
  return false;
}

// One step of `h`, in which the tools go from `begin` to `end` of their way.
bool ImplicitMethod::timeStep(double begin, double end, double h) {
  step_ = h;
  integrator_.beginStep(h, &potential_);
  body_.elasticity->beginStep(h);
  if (!prepared_) minimizer_->prepare(potential_, body_.x);
  prepared_ = true;
  startFromPredictor(begin, h);
  solveStages(begin, end);
  if (!acceptable()) return false;
  const PhaseTimer timer(&out_->phases, Phase::kForces);
  if (integrator_.needsElasticGradient()) body_.elasticity->gradient(body_.x, &elastic_gradient_);
  integrator_.endStep(body_.x, elastic_gradient_);
  body_.elasticity->endStep(body_.x);
  body_.contact.endStep(body_.x);
  if (out_->status == solver::SolveStatus::kConverged) body_.contact.settle(body_.x, h);
  return true;
}

// From where the velocities lead if they go on changing as they did, if that is better than from
// where the body is.
void ImplicitMethod::startFromPredictor(double s, double h) {
  const PhaseTimer timer(&out_->phases, Phase::kForces);
  body_.sweep.place(s);
  body_.sweep.beginStep(body_.x);
  begin_x_ = body_.x;
  const double value_here = valueHere();
  integrator_.extrapolate(h, &way_);
  way_ = way_.cwiseProduct(body_.free);  // held components: only rounding, which would grow
  predicted_ = body_.x + potential_.maxStep(body_.x, way_) * way_;
  // Of all that is computed here most is kept for the first iteration, which begins at one of both.
  const double value_there = potential_.gradient(predicted_, &gradient_there_);
  if (value_there < value_here) body_.x.swap(predicted_);  // false for NaN
}

double ImplicitMethod::valueHere() {
  if (!body_.elastic_energy) return potential_.value(body_.x);
  double sum = potential_.elastic_scale * *body_.elastic_energy;
  for (const fem::EnergyTerm* term : potential_.terms) sum += term->value(body_.x);
  body_.elastic_energy.reset();  // x goes on
  return sum;
}

// The tools go on as far as the tissue can follow, it is solved, and so on to the end.
void ImplicitMethod::solveStages(double begin, double end) {
  out_->tolerance = body_.tolerance();
  solver::NewtonReport solved;
  for (double s = begin; s < end;) {
    const double from = s;
    {
      const PhaseTimer timer(&out_->phases, Phase::kContact);
      s = body_.sweep.next(body_.x, s, end);
      ++out_->sweep_stages;
    }
    followTools(from, s, from == begin ? begin_x_ : body_.x);
    solved.status = moveHeld(s);
    if (solved.status != solver::SolveStatus::kConverged) break;
    solved = solveStage(s < end);
    if (s < end) continue;
    for (int k = 0; k < kMaxSettlings && solved.status == solver::SolveStatus::kConverged; ++k) {
      if (settled()) break;
      solved = solveStage(false);
    }
  }
  out_->status = solved.status;
  out_->residual = solved.residual;
  out_->satisfied =
      out_->newton_iterations == 0 && solved.status == solver::SolveStatus::kConverged;
}

// Brings the tools from part `from` of the cycle to part `to`, and what they touch with them: from
// `x` as the tangent there says, to first order, if that is better than where the body is. It
// spares Newton's method finding the points that stay in touch one after another.
void ImplicitMethod::followTools(double from, double to, const Points& x) {
  double value = 0.0;
  {
    const PhaseTimer timer(&out_->phases, Phase::kContact);
    const bool touching = body_.sweep.pushTo(to, x, &push_);
    body_.sweep.place(to);
    if (!touching) return;
    value = potential_.gradient(body_.x, &gradient_there_);
    const double residual = solver::freeNorm(gradient_there_, body_.free);
    if (residual <= kWorthFollowing * out_->tolerance) return;
    body_.sweep.place(from);
  }
  solver::NewtonReport step;
  const bool found = minimizer_->tangentStep(potential_, x, push_, kFollowTolerance, &way_, &step);
  add(step);
  const PhaseTimer timer(&out_->phases, Phase::kForces);
  body_.sweep.place(to);
  if (!found) return;
  predicted_ = x + potential_.maxStep(x, way_) * way_;
  if (potential_.gradient(predicted_, &gradient_there_) < value) body_.x.swap(predicted_);
}

void ImplicitMethod::add(const solver::NewtonReport& report) {
  out_->newton_iterations += report.iterations;
  out_->linear_iterations += report.linear_iterations;
  out_->kept_stiffnesses += report.kept_stiffnesses;
  out_->phases += report.phases;
}

// Held nodes that move take the others along as the tangent says.
solver::SolveStatus ImplicitMethod::moveHeld(double s) {
  if (!body_.heldWay(s, &way_)) return solver::SolveStatus::kConverged;
  const PhaseTimer timer(&out_->phases, Phase::kLinearSolve);
  return minimizer_->predict(potential_, way_, &body_.x);
}

// Whether contact is content with the solution; else it learns from it, for the next one.
bool ImplicitMethod::settled() {
  const PhaseTimer timer(&out_->phases, Phase::kContact);
  if (body_.contact.settled(body_.x)) return true;
  body_.contact.settle(body_.x, step_);
  return false;
}

solver::NewtonReport ImplicitMethod::solveStage(bool on_the_way) {
  solver::NewtonSettings settings;
  settings.linear_tolerance = body_.settings.linear_tolerance;
  settings.tolerance = (on_the_way ? kStageTolerance : 1.0) * out_->tolerance;
  if (body_.settings.position_tolerance == 0.0) {
    settings.tolerance = std::max(settings.tolerance, minimizer_->roundoffForce(body_.x));
  }
  settings.interrupt = body_.interrupt;
  settings.max_iterations = on_the_way ? kStageIterations : body_.settings.max_newton_iterations;
  solver::NewtonReport solved;
  for (int search = 0; search < kMaxSearches; ++search) {
    solved = minimizer_->minimize(potential_, settings, &body_.x);
    add(solved);
    const PhaseTimer timer(&out_->phases, Phase::kContact);
    if (body_.sweep.candidatesHold(body_.x)) break;
    body_.sweep.search(body_.x);
  }
  return solved;
}

// A state to go on from. One that only ran out of iterations or time is, unless it was asked to
// converge: each iteration lowered the energy.
bool ImplicitMethod::acceptable() const {
  const bool enough = body_.settings.only_converged ? out_->ok() : solver::usable(out_->status);
  return enough && body_.x.allFinite();
}

double ImplicitMethod::unbalancedForce() {
  integrator_.inertiaForces(body_.x, &inertia_forces_);
  return (minimizer_->gradient() + inertia_forces_).cwiseProduct(body_.free).norm();
}

void ImplicitMethod::reportForces(TissueStep* out) {
  integrator_.inertiaForces(body_.x, &inertia_forces_);
  out->inertia_force = inertia_forces_.rowwise().sum();
  body_.reportSupport(minimizer_->gradient(), out);
  body_.reportContacts(out);
}

}  // namespace palpate::tissue
