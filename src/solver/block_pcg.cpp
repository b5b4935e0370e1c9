// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/block_pcg.h"

#include <Eigen/LU>
#include <cmath>

namespace palpate::solver {

bool BlockPcg::invertDiagonal(const fem::Stiffness& A) {
  A.diagonal(&inverse_diagonal_);
  for (Mat3& inverse : inverse_diagonal_) {
    const Mat3 D = inverse;
    // Sylvester's criterion: leading minors.
    const double minor = D(0, 0) * D(1, 1) - D(0, 1) * D(1, 0);
    if (!(D(0, 0) > 0.0 && minor > 0.0 && D.determinant() > 0.0)) return false;
    inverse = D.inverse();
  }
  return true;
}

void BlockPcg::precondition(const Points& r, Points* z) const {
  z->resize(3, r.cols());
  for (Eigen::Index i = 0; i < r.cols(); ++i) z->col(i).noalias() = inverse_diagonal_[i] * r.col(i);
}

LinearReport BlockPcg::solve(const fem::Stiffness& A, const Points& b, double relative_tolerance,
                             Points* x) {
  LinearReport report;
  x->setZero(3, b.cols());
  const double target = relative_tolerance * b.norm();
  if (!std::isfinite(target)) return {SolveStatus::kNonFinite, 0};
  if (!invertDiagonal(A)) return {SolveStatus::kNotPositiveDefinite, 0};
  r_ = b;
  precondition(r_, &z_);
  p_ = z_;
  double rz = r_.cwiseProduct(z_).sum();
  while (r_.norm() > target) {
    if (report.iterations == max_iterations_) {
      report.status = SolveStatus::kIterationLimit;
      return report;
    }
    A.multiply(p_, &Ap_);
    const double curvature = p_.cwiseProduct(Ap_).sum();
    if (!(curvature > 0.0)) {
      report.status =
          std::isfinite(curvature) ? SolveStatus::kNotPositiveDefinite : SolveStatus::kNonFinite;
      return report;
    }
    const double alpha = rz / curvature;
    *x += alpha * p_;
    r_ -= alpha * Ap_;
    precondition(r_, &z_);
    const double rz_next = r_.cwiseProduct(z_).sum();
    p_ = z_ + (rz_next / rz) * p_;
    rz = rz_next;
    ++report.iterations;
  }
  return report;
}

}  // namespace palpate::solver
