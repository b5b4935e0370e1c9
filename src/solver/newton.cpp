// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/newton.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace palpate::solver {
namespace {

constexpr double kSufficientDecrease = 1e-4;
constexpr int kMaxHalvings = 30;
constexpr double kRoundoff = 1e-11;  // of the value: below it, differences of values are noise

// Near the end a linear solve to the last digit asked for is cheaper than another iteration with
// its assembly; far from it, accuracy is lost on a model that is not good yet.
double linearTolerance(const NewtonSettings& settings, double residual) {
  const double last = 0.3 * settings.tolerance / residual;
  const bool near_the_end = last >= 0.03 * settings.linear_tolerance;
  return near_the_end ? std::min(settings.linear_tolerance, last) : settings.linear_tolerance;
}

double freeNorm(const Points& g, const fem::FreeMask& free) { return g.cwiseProduct(free).norm(); }

}  // namespace

LinearReport Newton::direction(const Potential& potential, const Points& x, double linear_tolerance,
                               LinearSolver* linear, NewtonReport* report) {
  right_ = -g_.cwiseProduct(potential.free);
  LinearReport solved;
  for (const fem::Tangent tangent :
       {fem::Tangent::kExact, fem::Tangent::kConvexTerms, fem::Tangent::kProjected}) {
    {
      const PhaseTimer timer(&report->phases, Phase::kAssembly);
      potential.hessian(x, tangent, &A_);
      A_.constrain(potential.free);
    }
    const PhaseTimer timer(&report->phases, Phase::kLinearSolve);
    solved = linear->solve(A_, right_, linear_tolerance, &d_);
    report->linear_iterations += solved.iterations;
    if (solved.status != SolveStatus::kNotPositiveDefinite) break;
    ++report->projections;
  }
  return solved;
}

bool Newton::lineSearch(const Potential& potential, double value, Points* x, double* next_value,
                        NewtonReport* report) {
  const PhaseTimer timer(&report->phases, Phase::kLineSearch);
  const double slope = g_.cwiseProduct(d_).sum();
  const double norm = freeNorm(g_, potential.free);
  const bool conservative = potential.conservative();
  double alpha = potential.maxStep(*x, d_);
  for (int k = 0; k <= kMaxHalvings; ++k, alpha *= 0.5) {
    x_trial_ = *x + alpha * d_;
    *next_value = potential.gradient(x_trial_, &g_trial_);
    const double next_norm = freeNorm(g_trial_, potential.free);
    if (!std::isfinite(*next_value) || !std::isfinite(next_norm)) continue;
    const bool smaller_residual = next_norm <= (1.0 - kSufficientDecrease * alpha) * norm;
    const bool decrease = *next_value <= value + kSufficientDecrease * alpha * slope;
    const bool in_the_noise = std::abs(alpha * slope) <= kRoundoff * std::abs(value);
    if (conservative ? decrease || (in_the_noise && smaller_residual) : smaller_residual) {
      x->swap(x_trial_);
      g_.swap(g_trial_);
      return true;
    }
  }
  return false;
}

NewtonReport Newton::minimize(const Potential& potential, const NewtonSettings& settings,
                              LinearSolver* linear, Points* x) {
  NewtonReport report;
  double value = 0.0;
  {
    const PhaseTimer timer(&report.phases, Phase::kForces);
    value = potential.gradient(*x, &g_);
  }
  for (;;) {
    report.residual = freeNorm(g_, potential.free);
    if (!std::isfinite(value) || !std::isfinite(report.residual)) {
      report.status = SolveStatus::kNonFinite;
      return report;
    }
    if (report.residual <= settings.tolerance) return report;
    if (report.iterations == settings.max_iterations) {
      report.status = SolveStatus::kIterationLimit;
      return report;
    }
    const LinearReport solved =
        direction(potential, *x, linearTolerance(settings, report.residual), linear, &report);
    if (solved.status == SolveStatus::kNonFinite ||
        solved.status == SolveStatus::kNotPositiveDefinite) {
      report.status = solved.status;
      return report;
    }
    if (!lineSearch(potential, value, x, &value, &report)) {
      report.status = SolveStatus::kLineSearchFailed;
      return report;
    }
    ++report.iterations;
  }
}

double Newton::roundoffForce(const Points& x) const {
  double stiffness = 0.0;
  std::vector<Mat3> diagonal;
  A_.diagonal(&diagonal);
  for (const Mat3& block : diagonal) stiffness += block.trace();
  return 1e-15 * stiffness / (3.0 * A_.numNodes()) * x.norm();
}

SolveStatus Newton::predict(const Potential& potential, const Points& move, LinearSolver* linear,
                            Points* x) {
  const double value = potential.gradient(*x, &g_);
  if (!std::isfinite(value) || !g_.allFinite()) return SolveStatus::kNonFinite;
  potential.hessian(*x, fem::Tangent::kProjected, &A_);
  A_.multiply(move, &right_);
  right_ = -(g_ + right_).cwiseProduct(potential.free);
  A_.constrain(potential.free);
  const LinearReport solved = linear->solve(A_, right_, 1e-8, &d_);
  if (solved.status != SolveStatus::kConverged) return solved.status;
  x_trial_ = *x + move + d_;
  if (!std::isfinite(potential.value(x_trial_))) return SolveStatus::kLineSearchFailed;
  x->swap(x_trial_);
  return SolveStatus::kConverged;
}

}  // namespace palpate::solver
