// SPDX-License-Identifier: GPL-3.0-or-later
#include "cholmod_factor.h"

namespace palpate::solver {

CholmodFactor::CholmodFactor() {
  cholmod_start(&common_);
  common_.print = 0;
  common_.error_handler = nullptr;
  common_.quick_return_if_not_posdef = 1;
}

CholmodFactor::~CholmodFactor() {
  cholmod_free_factor(&factor_, &common_);
  cholmod_free_dense(&solution_, &common_);
  cholmod_free_dense(&work_y_, &common_);
  cholmod_free_dense(&work_e_, &common_);
  matrix_.reset();
  cholmod_finish(&common_);
}

void CholmodFactor::analyze(const fem::Stiffness& A) {
  if (matrix_) return;
  matrix_ = makeCholmodMatrix(A, &common_);
  if (matrix_->numPressures() > 0) {
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.final_ll = 0;
  }
  factor_ = cholmod_analyze(matrix_->sparse(), &common_);
  padded_.setZero(static_cast<Eigen::Index>(matrix_->sparse()->nrow));
}

// A quasi-definite system has as many negative pivots as pressures if and only if A is positive
// definite [Sylvester's law of inertia].
bool CholmodFactor::positiveDefinite() const {
  if (common_.status == CHOLMOD_NOT_POSDEF || factor_->minor < factor_->n) return false;
  if (matrix_->numPressures() == 0) return true;
  int negative = 0;
  const auto* start = static_cast<const int*>(factor_->p);
  const auto* value = static_cast<const double*>(factor_->x);
  for (std::size_t k = 0; k < factor_->n; ++k) negative += value[start[k]] < 0.0 ? 1 : 0;
  return negative == matrix_->numPressures();
}

SolveStatus CholmodFactor::factorize(const fem::Stiffness& A) {
  analyze(A);
  matrix_->assign(A);
  cholmod_sparse* sparse = matrix_->sparse();
  const auto* values = static_cast<const double*>(sparse->x);
  const Eigen::Map<const Eigen::VectorXd> all(values, static_cast<Eigen::Index>(sparse->nzmax));
  if (!all.allFinite()) return SolveStatus::kNonFinite;
  cholmod_factorize(sparse, factor_, &common_);
  return positiveDefinite() ? SolveStatus::kConverged : SolveStatus::kNotPositiveDefinite;
}

SolveStatus CholmodFactor::solve(const Points& b, Points* x) {
  padded_.head(b.size()) = Eigen::Map<const Eigen::VectorXd>(b.data(), b.size());
  cholmod_dense right = {};
  right.nrow = right.nzmax = right.d = static_cast<std::size_t>(padded_.size());
  right.ncol = 1;
  right.x = padded_.data();
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  // Keeps its work space between calls.
  if (!cholmod_solve2(CHOLMOD_A, factor_, &right, nullptr, &solution_, nullptr, &work_y_, &work_e_,
                      &common_)) {
    return SolveStatus::kNonFinite;
  }
  *x = Eigen::Map<const Points>(static_cast<const double*>(solution_->x), 3, b.cols());
  return x->allFinite() ? SolveStatus::kConverged : SolveStatus::kNonFinite;
}

}  // namespace palpate::solver
