// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/lbfgs.h"

#include <algorithm>
#include <utility>

#include "minimizer_parts.h"
#include "palpate/solver/unit_costs.h"
#include "stale_factor.h"

namespace palpate::solver {
namespace {

// Iterations per minimisation beyond which the factor counts as old; a fresh factor needs about
// three. Immediate renewal would delay a live cycle for little gain.
constexpr int kIterationsOfRenewal = 8;
// Iterations of a minimisation before the factor is renewed at any cost.
constexpr int kPatience = 30;

// Pairs with less relative curvature are noise and are left out.
constexpr double kLeastCurvature = 1e-10;

}  // namespace

Lbfgs::Lbfgs(fem::Stiffness A)
    : A_(std::move(A)), factor_(std::make_unique<StaleFactor>()), terms_(A_.blocks()) {
  factor_->analyze(A_);
  renewal_ = factorSeconds() / triangularSolveSeconds(factor_->factor().nonzeros());
}

Lbfgs::~Lbfgs() = default;

double Lbfgs::factorSeconds() const { return factorizationSeconds(factor_->factor().flops()); }

void Lbfgs::restart() {
  factor_->forget();
  num_pairs_ = 0;
  wasted_ = 0.0;
}

void Lbfgs::save(StateWriter* out) const {
  factor_->save(out);
  if (factor_->ready()) out->put(elastic_diagonal_);
  out->put(wasted_);
  out->put(newest_);
  out->put(num_pairs_);
  for (int k = 0; k < num_pairs_; ++k) {
    const Pair& p = pair(k);
    out->put(p.s);
    out->put(p.y);
    out->put(p.sy);
  }
}

void Lbfgs::restore(StateReader* in) {
  num_pairs_ = 0;
  factor_->restore(in);
  if (factor_->ready()) in->get(&elastic_diagonal_);
  if (factor_->ready() && elastic_diagonal_.size() != factor_->diagonal().size()) {
    StateReader::fail();
  }
  in->get(&wasted_);
  in->get(&newest_);
  int pairs = 0;
  in->get(&pairs);
  if (newest_ < 0 || newest_ >= kPairs || pairs < 0 || pairs > kPairs) StateReader::fail();
  for (int k = 0; k < pairs; ++k) {
    Pair& p = pair(k);
    in->get(&p.s);
    in->get(&p.y);
    in->get(&p.sy);
    if (p.s.cols() != A_.numNodes() || p.y.cols() != A_.numNodes()) StateReader::fail();
  }
  num_pairs_ = pairs;
}

// Uses the projected tangent, positive definite where masses or supports hold the body.
SolveStatus Lbfgs::renew(const Potential& potential, const Points& x, PhaseTimes* phases) {
  {
    const PhaseTimer timer(phases, Phase::kAssembly);
    potential.hessian(x, fem::Tangent::kProjected, &A_);
    A_.constrain(potential.free);
  }
  const PhaseTimer timer(phases, Phase::kLinearSolve);
  num_pairs_ = 0;
  wasted_ = 0.0;
  const SolveStatus status = factor_->factorize(A_);
  if (status != SolveStatus::kConverged) return status;
  elastic_diagonal_ = factor_->diagonal();
  terms_.setZero();
  potential.addTermHessians(x, fem::Tangent::kProjected, &terms_);
  for (int i = 0; i < terms_.numNodes(); ++i) {
    const auto F = potential.free.col(i).asDiagonal();
    elastic_diagonal_[i] -= F * terms_.blocks().block(terms_.blocks().diagonal(i)) * F;
  }
  return status;
}

bool Lbfgs::scaleFactor(const Potential& potential, const Points& x) {
  terms_.setZero();
  potential.addTermHessians(x, fem::Tangent::kProjected, &terms_);
  diagonal_.resize(elastic_diagonal_.size());
  for (int i = 0; i < terms_.numNodes(); ++i) {
    const auto F = potential.free.col(i).asDiagonal();
    diagonal_[i] =
        elastic_diagonal_[i] + F * terms_.blocks().block(terms_.blocks().diagonal(i)) * F;
  }
  return factor_->scaleTo(diagonal_);
}

// Computes d = -H g by the two loops of alg. 7.4.
bool Lbfgs::direction(const Potential& potential, const Points& x, PhaseTimes* phases) {
  const PhaseTimer timer(phases, Phase::kLinearSolve);
  if (!scaleFactor(potential, x)) return false;
  right_ = -g_.cwiseProduct(potential.free);
  for (int k = 0; k < num_pairs_; ++k) {
    Pair& p = pair(k);
    p.alpha = p.s.cwiseProduct(right_).sum() / p.sy;
    right_ -= p.alpha * p.y;
  }
  if (!factor_->apply(right_, &d_)) return false;
  for (int k = num_pairs_ - 1; k >= 0; --k) {
    const Pair& p = pair(k);
    const double beta = p.y.cwiseProduct(d_).sum() / p.sy;
    d_ += (p.alpha - beta) * p.s;
  }
  return d_.cwiseProduct(g_).sum() < 0.0;
}

// Stores the secant pair of the step to x.
void Lbfgs::learn(const Potential& potential, const Points& x) {
  const int place = (newest_ + 1) % kPairs;
  Pair& p = pairs_[place];
  p.s = x - x_begin_;
  p.y = (g_ - g_begin_).cwiseProduct(potential.free);
  p.sy = p.s.cwiseProduct(p.y).sum();
  if (!(p.sy > kLeastCurvature * p.s.norm() * p.y.norm())) {
    if (num_pairs_ == kPairs) --num_pairs_;  // its storage was overwritten
    return;
  }
  newest_ = place;
  num_pairs_ = std::min(num_pairs_ + 1, kPairs);
}

bool Lbfgs::search(const Potential& potential, const NewtonSettings& settings, Points* x,
                   double* value, NewtonReport* report) {
  const PhaseTimer timer(&report->phases, Phase::kLineSearch);
  const bool found = line_search_.run(potential, d_, x, &g_, value, settings.interrupt,
                                      report->iterations > 0 ? 1 : settings.least_halvings);
  report->halvings += line_search_.halvings();
  return found;
}

NewtonReport Lbfgs::minimize(const Potential& potential, const NewtonSettings& settings,
                             Points* x) {
  NewtonReport report;
  const auto gradient = [&] {
    const PhaseTimer timer(&report.phases, Phase::kForces);
    return potential.gradient(*x, &g_);
  };
  double value = gradient();
  int since_renewal = 0;
  for (;;) {
    if (isOver(value, g_, potential.free, settings, iterationsForOne() * settings.max_iterations,
               &report)) {
      return report;
    }
    bool fresh = false;
    if (!factor_->ready() || wasted_ >= renewal_ || since_renewal >= kPatience) {
      report.status = renew(potential, *x, &report.phases);
      if (report.status != SolveStatus::kConverged) return report;
      since_renewal = 0;
      fresh = true;
    }
    x_begin_ = *x;
    g_begin_ = g_;
    while (!direction(potential, *x, &report.phases) ||
           !search(potential, settings, x, &value, &report)) {
      if (settings.interrupted()) {
        wasted_ = renewal_;  // requests a renewal at a later time
        report.status = SolveStatus::kDeadline;
        return report;
      }
      report.status = fresh ? SolveStatus::kLineSearchFailed : renew(potential, *x, &report.phases);
      if (report.status != SolveStatus::kConverged) return report;
      since_renewal = 0;
      fresh = true;
    }
    learn(potential, *x);
    ++report.iterations;
    ++since_renewal;
    if (since_renewal > kIterationsOfRenewal) wasted_ += 1.0;
  }
}

double Lbfgs::roundoffForce(const Points& x) const { return solver::roundoffForce(A_, x); }

SolveStatus Lbfgs::predict(const Potential& potential, const Points& move, Points* x) {
  if (!tangentSystem(potential, *x, move, &A_, &g_, &right_)) return SolveStatus::kNonFinite;
  restart();
  SolveStatus status = factor_->factorize(A_);
  factor_->forget();  // its diagonal was not split into parts
  if (status == SolveStatus::kConverged && !factor_->apply(right_, &d_)) {
    status = SolveStatus::kNonFinite;
  }
  if (status != SolveStatus::kConverged) return status;
  return moveIfFinite(potential, move, d_, x, &x_trial_);
}

}  // namespace palpate::solver
