// SPDX-License-Identifier: GPL-3.0-or-later
#include "implicit_steps.h"

#include <algorithm>
#include <cmath>

#include "palpate/solver/line_search.h"
#include "tissue/touch/stage_limits.h"

namespace palpate::tissue {
namespace {

// Residual over the tolerance by present forces above which a tolerance is stale [-].
constexpr double kStaleToleranceFactor = 10.0;
// Residual over tolerance above which a tangent step follows the tools [-]; below it Newton's
// method takes one or two iterations.
constexpr double kMinFollowRatio = 100.0;
constexpr double kFollowLinearTolerance = 0.01;  // relative tolerance of that linear solve [-]

}  // namespace

void ImplicitSteps::save(StateWriter* out) const {
  out->put(prepared_);
  out->put(stalled_);
  minimizer_->save(out);
}

void ImplicitSteps::restore(StateReader* in) {
  in->get(&prepared_);
  in->get(&stalled_);
  minimizer_->restore(in);
}

void ImplicitSteps::prepare(double dt) {
  bodies_.beginStep(0.0, dt);
  prepareHere();
}

void ImplicitSteps::prepareHere() {
  if (!prepared_) minimizer_->prepare(bodies_.potential(), bodies_.x());
  prepared_ = true;
}

// Solves the cycle in one step or, after failures, in more and shorter ones.
bool ImplicitSteps::advance(double dt, TissueStep* out) {
  out_ = out;
  const int waits = minimizer_->waits();
  {
    const PhaseTimer timer(&out_->phases, Phase::kLinearSolve);
    minimizer_->beginCycle(dt);
  }
  out_->factor_waits = minimizer_->waits() - waits;
  bodies_.beginCycle();
  budget_.beginCycle();
  iterations_ = 0;
  const int most = bodies_.settings().max_time_steps;
  bool solved = false;
  for (int steps = 1; steps <= most && !solved; steps *= 2) {
    // Without budget, attempts with fewer than the most steps would fail as well.
    if (steps > 1 && budget_.left() <= 0) {
      while (2 * steps <= most) steps *= 2;
    }
    budget_.beginTrial();
    out_->time_steps = steps;
    out_->sweep_stages = 0;
    int done = 0;
    while (done < steps && timeStep(done / double(steps), (done + 1) / double(steps), dt / steps)) {
      ++done;
    }
    solved = done == steps;
    if (solved) break;
    bodies_.goBack();
    // Shorter steps take longer: at a deadline the cycle counts as late, not as failed.
    if (!solver::isInterrupted(bodies_.interrupt())) continue;
    const bool last = 2 * steps > most;
    if (!last || solver::usable(out_->status)) out_->status = solver::SolveStatus::kDeadline;
    break;
  }
  bodies_.endCycle();
  const bool nowhere = iterations_ == 0 || !solved;
  stalled_ = out->status == solver::SolveStatus::kDeadline && nowhere;
  return solved;
}

// Solves one step of `h` [s] with the tools moving from fraction `begin` to `end` of their path.
bool ImplicitSteps::timeStep(double begin, double end, double h) {
  if (bodies_.beginStep(begin, h)) forgetLearnt();
  {
    const PhaseTimer timer(&out_->phases, Phase::kLinearSolve);
    prepareHere();
  }
  startFromPredictor(begin, end, h);
  solveStages(begin, end);
  if (!acceptable()) return false;
  const PhaseTimer timer(&out_->phases, Phase::kForces);
  const bool solved = out_->status == solver::SolveStatus::kConverged;
  bodies_.endStep(solved ? 0.0 : out_->residual);
  if (solved) bodies_.learn(h);
  return true;
}

// Starts from the extrapolation of velocities if its potential is lower than at the present
// positions. Prescribed nodes are at the step's end in both, so that their work does not decide.
void ImplicitSteps::startFromPredictor(double begin, double end, double h) {
  const PhaseTimer timer(&out_->phases, Phase::kForces);
  Points& x = bodies_.x();
  const solver::Potential& potential = bodies_.potential();
  bodies_.moveTools(begin);
  bodies_.beginTouches();
  begin_x_ = x;
  bodies_.extrapolate(h, &way_);
  predicted_ = x + potential.maxStep(x, way_) * way_;
  bodies_.moveSurroundings(end);
  if (bodies_.carries()) {
    bodies_.carryTo(end, &predicted_);
    bodies_.carryHere(end);
  }
  const double value_here = bodies_.valueHere();
  // The first iteration reuses this evaluation.
  const double value_there = potential.gradient(predicted_, &gradient_there_);
  const bool better = value_there < value_here;  // also false for NaN
  if (!better && !std::isfinite(value_here)) {
    x = begin_x_;  // moveHeld() moves the other nodes
    return;
  }
  if (better) x.swap(predicted_);
  if (bodies_.carries()) bodies_.carryTo(end, &begin_x_);
}

// Moves the tools stage by stage to `end`, and solves the tissue after each.
void ImplicitSteps::solveStages(double begin, double end) {
  out_->tolerance = bodies_.tolerance();
  solver::NewtonReport solved;
  for (double s = begin; s < end;) {
    const double from = s;
    // Before the deadline a stage ends where the tissue can follow; after it the last stage begins
    // at once.
    const bool late = solver::isInterrupted(bodies_.interrupt());
    {
      const PhaseTimer timer(&out_->phases, Phase::kContact);
      s = late ? end : bodies_.nextStage(s, end);
      if (late) bodies_.invalidateInsideTools();
      ++out_->sweep_stages;
      budget_.beginStage();
    }
    const bool followed = followTools(from, s, from == begin ? begin_x_ : bodies_.x(), !late);
    solved.status = moveHeld(s, end);
    if (solved.status != solver::SolveStatus::kConverged) break;
    solved = solveStage(s < end, followed);
    if (startGuarding()) solved = solveStage(s < end);
    if (s < end) continue;
    const int most = bodies_.hasFriction() ? kMaxFrictionAugmentations : kMaxAugmentations;
    for (int k = 0; k < most && solved.status == solver::SolveStatus::kConverged; ++k) {
      const bool converged = augmentationConverged();
      if (converged && !toleranceIsStale(solved.residual)) break;
      if (budget_.left() <= 0) {  // multipliers and limits stay those of x
        solved.status = solver::SolveStatus::kIterationLimit;
        break;
      }
      if (!converged) augment();
      solved = solveStage(false);
      if (startGuarding()) solved = solveStage(false);
    }
  }
  out_->status = solved.status;
  out_->residual = solved.residual;
  out_->satisfied =
      out_->newton_iterations == 0 && solved.status == solver::SolveStatus::kConverged;
}

// Moves the tools from fraction `from` of the cycle to `to`, and the tissue by a tangent step at
// `x` if that lowers the potential. Returns whether it did. Saves Newton's method from finding
// persistent contacts one by one. Skipped after the deadline.
bool ImplicitSteps::followTools(double from, double to, const Points& x, bool in_time) {
  const solver::Potential& potential = bodies_.potential();
  double value = 0.0;
  {
    const PhaseTimer timer(&out_->phases, Phase::kContact);
    const bool touching = bodies_.pushTo(to, x, &push_);
    bodies_.moveTools(to);
    if (!touching || !in_time) return false;
    value = potential.gradient(bodies_.x(), &gradient_there_);
    const double residual = solver::freeNorm(gradient_there_, potential.free);
    if (residual <= kMinFollowRatio * out_->tolerance) return false;
    bodies_.moveTools(from);
  }
  solver::NewtonReport step;
  const bool found =
      minimizer_->tangentStep(potential, x, push_, kFollowLinearTolerance, &way_, &step);
  add(step);
  const PhaseTimer timer(&out_->phases, Phase::kForces);
  bodies_.moveTools(to);
  if (!found) return false;
  predicted_ = x + potential.maxStep(x, way_) * way_;
  const bool better = potential.gradient(predicted_, &gradient_there_) < value;
  if (better) bodies_.x().swap(predicted_);
  return better;
}

void ImplicitSteps::add(const solver::NewtonReport& report) {
  out_->newton_iterations += report.iterations;
  out_->linear_iterations += report.linear_iterations;
  out_->kept_stiffnesses += report.kept_stiffnesses;
  out_->phases += report.phases;
  budget_.spend(report);
}

// Moves prescribed nodes, and the others by a tangent step. Carried nodes are at the step's end
// from its begin, so that they cost once a step, not once a stage.
solver::SolveStatus ImplicitSteps::moveHeld(double s, double end) {
  if (!bodies_.heldWay(bodies_.carries() ? end : s, &way_)) return solver::SolveStatus::kConverged;
  const PhaseTimer timer(&out_->phases, Phase::kLinearSolve);
  return minimizer_->predict(bodies_.potential(), way_, &bodies_.x());
}

// Whether contact needs no further augmentation at x.
bool ImplicitSteps::augmentationConverged() {
  const PhaseTimer timer(&out_->phases, Phase::kContact);
  return bodies_.augmentationConverged();
}

// Whether the residual meets the tolerance only by forces of a tool that has left. Then the
// tolerance becomes that by the present forces.
bool ImplicitSteps::toleranceIsStale(double residual) {
  if (residual <= kStaleToleranceFactor * bodies_.leastTolerance())
    return false;  // without summing forces
  const PhaseTimer timer(&out_->phases, Phase::kContact);
  const double here = bodies_.toleranceHere(minimizer_->gradient());
  if (residual <= kStaleToleranceFactor * here || here >= out_->tolerance) return false;
  out_->tolerance = here;
  return true;
}

void ImplicitSteps::augment() {
  const PhaseTimer timer(&out_->phases, Phase::kContact);
  bodies_.augment();
}

bool ImplicitSteps::startGuarding() {
  const PhaseTimer timer(&out_->phases, Phase::kForces);
  if (!bodies_.startGuarding()) return false;
  out_->recover(Recovery::kSolvedAgain);
  return true;
}

// Solves a stage. `followed`: a tangent step counts as its first iteration.
solver::NewtonReport ImplicitSteps::solveStage(bool on_the_way, bool followed) {
  const FemSettings& of_scene = bodies_.settings();
  solver::NewtonSettings settings;
  settings.linear_tolerance = of_scene.linear_tolerance;
  settings.tolerance = (on_the_way ? kStageTolerance : 1.0) * out_->tolerance;
  if (of_scene.position_tolerance == 0.0) {
    settings.tolerance = std::max(settings.tolerance, minimizer_->roundoffForce(bodies_.x()));
  }
  settings.interrupt = bodies_.interrupt();
  // After a cycle without progress before its deadline, line searches must not end early.
  if (stalled_) settings.least_halvings = solver::LineSearch::kMaxHalvings + 1;
  settings.least_iterations = followed ? 0 : 1;
  settings.max_iterations = budget_.ofNextSolve(on_the_way);
  solver::NewtonReport solved;
  for (int search = 0; search < kMaxSearches; ++search) {
    solved = minimizer_->minimize(bodies_.potential(), settings, &bodies_.x());
    add(solved);
    iterations_ += solved.iterations;
    const PhaseTimer timer(&out_->phases, Phase::kContact);
    if (bodies_.candidatesHold() || solved.status == solver::SolveStatus::kDeadline) break;
    bodies_.search();
  }
  return solved;
}

// Whether the step is accepted. A state at an iteration limit or deadline is, unless
// only_converged: each iteration lowered the potential. Inverted elements are accepted only without
// further attempts or time.
bool ImplicitSteps::acceptable() {
  const bool only_converged = bodies_.settings().only_converged;
  const bool enough = only_converged ? out_->ok() : solver::usable(out_->status);
  if (!enough || !bodies_.x().allFinite()) return false;
  const bool last = 2 * out_->time_steps > bodies_.settings().max_time_steps;
  return last || solver::isInterrupted(bodies_.interrupt()) || !bodies_.inverted();
}

}  // namespace palpate::tissue
