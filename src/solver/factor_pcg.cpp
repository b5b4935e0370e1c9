// SPDX-License-Identifier: GPL-3.0-or-later
#include "factor_pcg.h"

#include <cmath>

#include "palpate/solver/block_pcg.h"
#include "palpate/solver/unit_costs.h"

namespace palpate::solver {

double FactorPcg::iterationSeconds(const fem::Stiffness& A, const StaleFactor& factor) {
  return BlockPcg::iterationSeconds(A) + triangularSolveSeconds(factor.factor().nonzeros());
}

LinearReport FactorPcg::solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                              int most, const Interrupt* interrupt, StaleFactor* factor,
                              Points* x) {
  LinearReport report;
  x->setZero(3, b.cols());
  const double target = relative_tolerance * b.norm();
  if (!std::isfinite(target)) return {SolveStatus::kNonFinite, 0};
  A.diagonal(&diagonal_);
  if (!factor->scaleTo(diagonal_)) return {SolveStatus::kNotPositiveDefinite, 0};
  r_ = b;
  double rz = 0.0;
  while (r_.norm() > target) {
    if (report.iterations == most) return {SolveStatus::kIterationLimit, report.iterations, true};
    if (report.iterations > 0 && report.iterations % 8 == 0 && isInterrupted(interrupt)) {
      return {SolveStatus::kDeadline, report.iterations};
    }
    if (!factor->apply(r_, &z_)) return {SolveStatus::kNonFinite, report.iterations};
    const double rz_next = r_.cwiseProduct(z_).sum();
    if (report.iterations == 0) {
      p_ = z_;
    } else {
      p_ = z_ + (rz_next / rz) * p_;
    }
    rz = rz_next;
    A.multiply(p_, &Ap_);
    const double curvature = p_.cwiseProduct(Ap_).sum();
    if (!(curvature > 0.0) || !std::isfinite(curvature)) {
      report.status =
          std::isfinite(curvature) ? SolveStatus::kNotPositiveDefinite : SolveStatus::kNonFinite;
      return report;
    }
    const double alpha = rz / curvature;
    *x += alpha * p_;
    r_ -= alpha * Ap_;
    ++report.iterations;
  }
  if (!x->allFinite() || !r_.allFinite()) report.status = SolveStatus::kNonFinite;
  return report;
}

}  // namespace palpate::solver
