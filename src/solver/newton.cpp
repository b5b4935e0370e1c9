// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/newton.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "kept_stiffness.h"
#include "minimizer_parts.h"

namespace palpate::solver {
namespace {

// Reduction of the residual per iteration above which a kept stiffness is too old [-].
constexpr double kWell = 0.5;

// Forcing terms of choice 2 with safeguard [Eisenstat, Walker 1996, (2.6)]: a linear solve need not
// be more accurate than Newton's last linear model.
double forcingTerm(double bound, double residual, double before, double last_term) {
  constexpr double kGamma = 0.9;
  const double ratio = residual / before;
  const double safeguard = kGamma * last_term * last_term;
  const double term = kGamma * ratio * ratio;
  return std::min(bound, safeguard > 0.1 ? std::max(term, safeguard) : term);
}

// In the last iteration a tight linear solve is cheaper than another iteration with assembly.
double atTheEnd(const NewtonSettings& settings, double residual, double term) {
  const double last = 0.3 * settings.tolerance / residual;
  return last >= 0.03 * settings.linear_tolerance ? std::min(settings.linear_tolerance, last)
                                                  : term;
}

}  // namespace

Newton::Newton(fem::Stiffness A, std::unique_ptr<LinearSolver> linear, bool keep_stiffness,
               ThreadPool* pool)
    : A_(std::move(A)), linear_(std::move(linear)) {
  linear_->takePattern(A_);
  if (keep_stiffness) elastic_ = std::make_unique<KeptStiffness>(A_, pool);
}

Newton::~Newton() = default;

void Newton::learnFromRest(const std::function<void(fem::Stiffness*)>& assemble) {
  if (elastic_) elastic_->matrixWasOverwritten();
  assemble(&A_);
  linear_->learnFromRest(A_);
}

void Newton::beginCycle(double dt) {
  if (elastic_) elastic_->beginCycle();
  linear_->beginCycle(dt);
}

void Newton::restart() {
  if (elastic_) elastic_->drop();
  linear_->restart();
}

void Newton::save(StateWriter* out) const {
  out->put(elastic_ != nullptr);
  if (elastic_) elastic_->save(out);
  linear_->save(out);
}

void Newton::restore(StateReader* in) {
  bool keeps = false;
  in->get(&keeps);
  if (keeps != (elastic_ != nullptr)) StateReader::fail();
  if (elastic_) elastic_->restore(in);
  linear_->restore(in);
}

// Assembles A_ at x, constrained, before a linear solve. Returns false if the cycle is interrupted:
// the linear solver then does not know A_, nor later changes.
bool Newton::assemble(const Potential& potential, const Points& x, fem::Tangent tangent,
                      const Interrupt* interrupt) {
  kept_ = false;
  if (!elastic_) {
    potential.hessian(x, tangent, &A_);
    A_.constrain(potential.free);
    return !isInterrupted(interrupt);
  }
  const KeptStiffness::Assembled assembled = elastic_->hessian(potential, x, tangent, &A_);
  if (isInterrupted(interrupt)) {
    elastic_->matrixWasOverwritten();
    return false;
  }
  kept_ = assembled.kept && tangent == fem::Tangent::kExact;
  if (assembled.changed) linear_->onlyChanged(*assembled.changed);
  return true;
}

// Whether a kept stiffness may be reused.
bool Newton::servedWell(double residual, double before) const {
  return line_search_.halvings() == 0 && residual <= kWell * before;
}

LinearReport Newton::direction(const Potential& potential, const Points& x, double linear_tolerance,
                               const Interrupt* interrupt, NewtonReport* report) {
  right_ = -g_.cwiseProduct(potential.free);
  constexpr fem::Tangent kTangents[] = {fem::Tangent::kExact, fem::Tangent::kConvexTerms,
                                        fem::Tangent::kProjected};
  LinearReport solved;
  for (const fem::Tangent* tangent = kTangents; tangent != std::end(kTangents);) {
    {
      const PhaseTimer timer(&report->phases, Phase::kAssembly);
      if (!assemble(potential, x, *tangent, interrupt)) {
        solved.status = SolveStatus::kDeadline;
        return solved;
      }
    }
    const PhaseTimer timer(&report->phases, Phase::kLinearSolve);
    solved = linear_->solve(A_, right_, linear_tolerance, &d_);
    report->linear_iterations += solved.iterations;
    if (solved.status != SolveStatus::kNotPositiveDefinite) break;
    ++report->projections;
    if (kept_) {
      elastic_->drop();
    } else {
      ++tangent;
    }
  }
  report->kept_stiffnesses += kept_;
  return solved;
}

NewtonReport Newton::minimize(const Potential& potential, const NewtonSettings& settings,
                              Points* x) {
  NewtonReport report;
  kept_ = false;
  linear_->setInterrupt(settings.interrupt);
  double before = 0.0, term = settings.linear_tolerance;
  double value = 0.0;
  {
    const PhaseTimer timer(&report.phases, Phase::kForces);
    value = potential.gradient(*x, &g_);
  }
  for (;;) {
    if (isOver(value, g_, potential.free, settings, settings.max_iterations, &report))
      return report;
    if (kept_ && before > 0.0 && !servedWell(report.residual, before)) elastic_->drop();
    if (before > 0.0) {
      term = forcingTerm(settings.linear_tolerance, report.residual, before, term);
    }
    const bool may_end = report.iterations >= settings.least_iterations;
    const LinearReport solved = direction(potential, *x, atTheEnd(settings, report.residual, term),
                                          may_end ? settings.interrupt : nullptr, &report);
    if (solved.status == SolveStatus::kNonFinite ||
        solved.status == SolveStatus::kNotPositiveDefinite ||
        (may_end && solved.status == SolveStatus::kDeadline)) {
      report.status = solved.status;
      return report;
    }
    const PhaseTimer timer(&report.phases, Phase::kLineSearch);
    const bool found = line_search_.run(potential, d_, x, &g_, &value, settings.interrupt,
                                        may_end ? 1 : settings.least_halvings);
    report.halvings += line_search_.halvings();
    if (!found) {
      if (kept_) elastic_->drop();
      const bool late = settings.interrupted();
      if (kept_ && !late) continue;
      report.status = late ? SolveStatus::kDeadline : SolveStatus::kLineSearchFailed;
      return report;
    }
    before = report.residual;
    ++report.iterations;
  }
}

bool Newton::tangentStep(const Potential& potential, const Points& x, const Points& push,
                         double linear_tolerance, Points* d, NewtonReport* report) {
  const double value = potential.gradient(x, &g_);
  if (!std::isfinite(value) || !g_.allFinite()) return false;
  g_ -= push;
  const LinearReport solved = direction(potential, x, linear_tolerance, nullptr, report);
  if (!usable(solved.status) || !d_.allFinite()) return false;
  *d = d_;
  ++report->iterations;
  return true;
}

double Newton::roundoffForce(const Points& x) const { return solver::roundoffForce(A_, x); }

void Newton::prepare(const Potential& potential, const Points& x) {
  if (!linear_->prepares()) return;
  if (elastic_) elastic_->matrixWasOverwritten();
  potential.hessian(x, fem::Tangent::kProjected, &A_);
  A_.constrain(potential.free);
  linear_->prepare(A_);
}

SolveStatus Newton::predict(const Potential& potential, const Points& move, Points* x) {
  if (elastic_) elastic_->matrixWasOverwritten();
  if (!tangentSystem(potential, *x, move, &A_, &g_, &right_)) return SolveStatus::kNonFinite;
  const LinearReport solved = linear_->solve(A_, right_, 1e-8, &d_);
  if (solved.status != SolveStatus::kConverged) return solved.status;
  return moveIfFinite(potential, move, d_, x, &x_trial_);
}

}  // namespace palpate::solver
