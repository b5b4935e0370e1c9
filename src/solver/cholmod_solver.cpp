// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/cholmod_solver.h"

#include <cholmod.h>

#include <algorithm>

#include "cholmod_matrix.h"

namespace palpate::solver {

struct CholmodSolver::Impl {
  cholmod_common common;
  std::unique_ptr<CholmodMatrix> matrix;
  cholmod_factor* factor = nullptr;

  Impl() {
    cholmod_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
    common.quick_return_if_not_posdef = 1;
  }
  ~Impl() {
    cholmod_free_factor(&factor, &common);
    matrix.reset();
    cholmod_finish(&common);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void analyze(const fem::Stiffness& A) {
    matrix = makeCholmodMatrix(A, &common);
    if (matrix->numPressures() > 0) {
      common.supernodal = CHOLMOD_SIMPLICIAL;
      common.final_ll = 0;
    }
    factor = cholmod_analyze(matrix->sparse(), &common);
  }

  // A quasi-definite system has as many negative pivots as pressures if and only if A is positive
  // definite [Sylvester's law of inertia].
  bool positiveDefinite() const {
    if (common.status == CHOLMOD_NOT_POSDEF || factor->minor < factor->n) return false;
    if (matrix->numPressures() == 0) return true;
    int negative = 0;
    const auto* start = static_cast<const int*>(factor->p);
    const auto* value = static_cast<const double*>(factor->x);
    for (std::size_t k = 0; k < factor->n; ++k) negative += value[start[k]] < 0.0 ? 1 : 0;
    return negative == matrix->numPressures();
  }
};

CholmodSolver::CholmodSolver() : impl_(std::make_unique<Impl>()) {}
CholmodSolver::~CholmodSolver() = default;

LinearReport CholmodSolver::solve(const fem::Stiffness& A, const Points& b, double, Points* x) {
  cholmod_common* common = &impl_->common;
  if (!b.allFinite()) return {SolveStatus::kNonFinite, 0};
  if (!impl_->matrix) impl_->analyze(A);
  impl_->matrix->assign(A);
  cholmod_sparse* sparse = impl_->matrix->sparse();
  const auto* values = static_cast<const double*>(sparse->x);
  const Eigen::Map<const Eigen::VectorXd> all(values, static_cast<Eigen::Index>(sparse->nzmax));
  if (!all.allFinite()) return {SolveStatus::kNonFinite, 0};
  cholmod_factorize(sparse, impl_->factor, common);
  if (!impl_->positiveDefinite()) return {SolveStatus::kNotPositiveDefinite, 0};

  Eigen::VectorXd padded = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(sparse->nrow));
  padded.head(b.size()) = Eigen::Map<const Eigen::VectorXd>(b.data(), b.size());
  cholmod_dense right = {};
  right.nrow = right.nzmax = right.d = sparse->nrow;
  right.ncol = 1;
  right.x = padded.data();
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, impl_->factor, &right, common);
  if (!solution) return {SolveStatus::kNonFinite, 0};
  *x = Eigen::Map<const Points>(static_cast<const double*>(solution->x), 3, b.cols());
  cholmod_free_dense(&solution, common);
  return {x->allFinite() ? SolveStatus::kConverged : SolveStatus::kNonFinite, 0};
}

}  // namespace palpate::solver
