// SPDX-License-Identifier: GPL-3.0-or-later
#include "implicit_steps.h"

#include <algorithm>
#include <cmath>

#include "palpate/solver/line_search.h"
#include "tissue/touch/stage_limits.h"

namespace palpate::tissue {
namespace {

// So many times beyond the tolerance of the forces that there are, a solution is none.
constexpr double kStaleToleranceFactor = 10.0;
// Unbalanced forces of less than this many tolerances Newton's method finds its way out of in one
// step or two.
constexpr double kMinFollowRatio = 100.0;
constexpr double kFollowLinearTolerance = 0.01;  // of the linear solve: better does not pay

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

// The cycle in one step, or, where that fails, in more and shorter ones.
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
    // Where a trial used up what there was, those between would fail as well.
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
    // Shorter steps take longer: where there were some to try, the cycle was only late.
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

// One step of `h`, in which the tools go from `begin` to `end` of their way.
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

// From where the velocities lead if they go on changing as they did, if that is better than from
// where the bodies are; carried nodes are where they will be in both, or lifting them would look
// like a loss.
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
  // Of all that is computed here most is kept for the first iteration, which begins at one of both.
  const double value_there = potential.gradient(predicted_, &gradient_there_);
  const bool better = value_there < value_here;  // false for NaN
  if (!better && !std::isfinite(value_here)) {
    x = begin_x_;  // the tangent brings the others along
    return;
  }
  if (better) x.swap(predicted_);
  if (bodies_.carries()) bodies_.carryTo(end, &begin_x_);
}

// The tools go on as far as the tissue can follow, it is solved, and so on to the end.
void ImplicitSteps::solveStages(double begin, double end) {
  out_->tolerance = bodies_.tolerance();
  solver::NewtonReport solved;
  for (double s = begin; s < end;) {
    const double from = s;
    // In time the tools go as far as the tissue can follow; late they go all the way at once, also
    // where a cycle is late as it begins, and its stages are left to those that follow it sooner.
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
      if (budget_.left() <= 0) {  // it keeps the contact that x was solved for
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

// Brings the tools from part `from` of the cycle to part `to`, and what they touch with them: from
// `x` as the tangent there says, to first order, if that is better than where the body is. It
// spares Newton's method finding the points that stay in touch one after another. True: it was. Not
// tried where no time is left: it may be an iteration for nothing.
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

// Held nodes that move take the others along as the tangent says. What surroundings carry has been
// where the step ends since it began, so that stages of a tool cost no more for it.
solver::SolveStatus ImplicitSteps::moveHeld(double s, double end) {
  if (!bodies_.heldWay(bodies_.carries() ? end : s, &way_)) return solver::SolveStatus::kConverged;
  const PhaseTimer timer(&out_->phases, Phase::kLinearSolve);
  return minimizer_->predict(bodies_.potential(), way_, &bodies_.x());
}

// Whether contact is converged with the solution; else it is another one from now on.
bool ImplicitSteps::augmentationConverged() {
  const PhaseTimer timer(&out_->phases, Phase::kContact);
  return bodies_.augmentationConverged();
}

// Whether this much out of balance is within the tolerance only because that is a part of forces
// that are gone, with a tool that leapt away: it is of those that there are from now on.
bool ImplicitSteps::toleranceIsStale(double residual) {
  if (residual <= kStaleToleranceFactor * bodies_.leastTolerance())
    return false;  // no forces need be summed
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

// Where it `followed` the tools, x is an iteration ahead already.
solver::NewtonReport ImplicitSteps::solveStage(bool on_the_way, bool followed) {
  const FemSettings& of_scene = bodies_.settings();
  solver::NewtonSettings settings;
  settings.linear_tolerance = of_scene.linear_tolerance;
  settings.tolerance = (on_the_way ? kStageTolerance : 1.0) * out_->tolerance;
  if (of_scene.position_tolerance == 0.0) {
    settings.tolerance = std::max(settings.tolerance, minimizer_->roundoffForce(bodies_.x()));
  }
  settings.interrupt = bodies_.interrupt();
  // What was not found in time once is not found the next time either: without them it would stay
  // where it is for good.
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

// A state to go on from. One that only ran out of iterations or time is, unless it was asked to
// converge: each iteration lowered the energy. One with elements inside out is the last resort, or
// what there is where no time is left for shorter steps: a body that began so would stay so.
bool ImplicitSteps::acceptable() {
  const bool only_converged = bodies_.settings().only_converged;
  const bool enough = only_converged ? out_->ok() : solver::usable(out_->status);
  if (!enough || !bodies_.x().allFinite()) return false;
  const bool last = 2 * out_->time_steps > bodies_.settings().max_time_steps;
  return last || solver::isInterrupted(bodies_.interrupt()) || !bodies_.inverted();
}

}  // namespace palpate::tissue
