// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/stale_pcg.h"

#include <algorithm>
#include <cmath>

#include "factor_pcg.h"
#include "palpate/solver/unit_costs.h"
#include "stale_factor.h"

namespace palpate::solver {
namespace {

// Iterations up to which the factor counts as fresh.
constexpr int kLeastMostIterations = 12;
// Factor on the estimated time of a factorisation, which may share its core.
constexpr double kLeeway = 1.5;
// Decay of the failed work per cycle [-].
constexpr double kKeptPart = 0.5;

}  // namespace

StalePcg::StalePcg(const fem::Stiffness& A, int max_iterations, bool own_thread)
    : max_iterations_(max_iterations),
      plain_(max_iterations),
      used_(std::make_unique<StaleFactor>()),
      next_(std::make_unique<StaleFactor>()),
      iterations_(std::make_unique<FactorPcg>()),
      snapshot_(A),
      background_(std::make_unique<Background>(own_thread)) {
  used_->analyze(A);
  next_->analyze(A);
  flops_ = next_->factor().flops();
}

StalePcg::~StalePcg() = default;

void StalePcg::restart() {
  background_->wait();
  used_->forget();
  is_older_ = false;
  in_vain_ = 0.0;
  most_iterations_ = 0;
  wanted_ = true;
}

void StalePcg::save(StateWriter* out) const {
  out->put(cycle_);
  out->put(take_at_);
  out->put(dt_);
  out->put(most_iterations_);
  out->put(in_vain_);
  out->put(is_older_);
  out->put(wanted_);
  used_->save(out);
  out->put(background_->underWay());
  if (background_->underWay()) snapshot_.save(out);
}

void StalePcg::restore(StateReader* in) {
  background_->wait();
  in->get(&cycle_);
  in->get(&take_at_);
  in->get(&dt_);
  in->get(&most_iterations_);
  in->get(&in_vain_);
  in->get(&is_older_);
  in->get(&wanted_);
  used_->restore(in);
  bool under_way = false;
  in->get(&under_way);
  if (!under_way) return;
  snapshot_.restore(in);
  factoriseSnapshot();
}

void StalePcg::prepare(const fem::Stiffness& A) {
  used_->factorize(A);  // if it fails, BlockPcg is used
  wanted_ = !used_->ready();
}

void StalePcg::beginCycle(double dt) {
  ++cycle_;
  dt_ = dt;
  in_vain_ *= kKeptPart;
  if (background_->underWay()) {
    if (cycle_ < take_at_) return;
    if (background_->wait()) ++waits_;
    if (next_->ready() && !is_older_) used_.swap(next_);
    is_older_ = false;
    most_iterations_ = 0;
  }
  wanted_ = !used_->ready() || most_iterations_ > kLeastMostIterations;
}

void StalePcg::beginFactor(const fem::Stiffness& A) {
  const double seconds = kLeeway * factorizationSeconds(flops_);
  take_at_ = cycle_ + 1 + static_cast<long>(std::ceil(std::min(seconds / dt_, 1e6)));
  snapshot_ = A;
  factoriseSnapshot();
  wanted_ = false;
}

void StalePcg::factoriseSnapshot() {
  background_->begin([this] { next_->factorize(snapshot_); });
}

double StalePcg::iterationSeconds(const fem::Stiffness& A) const {
  return used_->ready() ? FactorPcg::iterationSeconds(A, *used_) : BlockPcg::iterationSeconds(A);
}

// Iterations are limited by the cost of a factor.
int StalePcg::mostIterations(const fem::Stiffness& A) const {
  const double left = (factorizationSeconds(flops_) - in_vain_) / iterationSeconds(A);
  const int affordable = static_cast<int>(std::ceil(std::min(left, 1e6)));
  return std::min(std::max(affordable, kLeastMostIterations), max_iterations_);
}

LinearReport StalePcg::solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                             Points* x) {
  const LinearReport report = used_->ready() ? iterate(A, b, relative_tolerance, x)
                                             : iterateWithout(A, b, relative_tolerance, x);
  if (!report.in_vain) return report;
  in_vain_ += report.iterations * iterationSeconds(A);
  if (in_vain_ < factorizationSeconds(flops_) || isInterrupted(interrupt())) return report;
  const SolveStatus status = used_->factorize(A);
  if (status != SolveStatus::kConverged) return {status, report.iterations};
  in_vain_ = 0.0;
  most_iterations_ = 0;
  wanted_ = false;
  is_older_ = background_->underWay();
  const LinearReport again = iterate(A, b, relative_tolerance, x);
  return {again.status, report.iterations + again.iterations};
}

LinearReport StalePcg::iterateWithout(const fem::Stiffness& A, const Points& b,
                                      double relative_tolerance, Points* x) {
  plain_.setInterrupt(interrupt());
  const LinearReport report = plain_.solve(A, b, relative_tolerance, x);
  const bool good = report.status == SolveStatus::kConverged;
  if (wanted_ && good && dt_ > 0.0 && !background_->underWay()) beginFactor(A);
  return report;
}

LinearReport StalePcg::iterate(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                               Points* x) {
  const LinearReport report =
      iterations_->solve(A, b, relative_tolerance, mostIterations(A), interrupt(), used_.get(), x);
  if (report.status == SolveStatus::kNonFinite ||
      report.status == SolveStatus::kNotPositiveDefinite) {
    return report;
  }
  most_iterations_ = std::max(most_iterations_, report.iterations);
  if (wanted_ && !background_->underWay()) beginFactor(A);
  return report;
}

}  // namespace palpate::solver
