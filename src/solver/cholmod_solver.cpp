// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/cholmod_solver.h"

#include <cholmod.h>

#include <algorithm>

namespace palpate::solver {

struct CholmodSolver::Impl {
  cholmod_common common;
  cholmod_sparse* matrix = nullptr;
  cholmod_factor* factor = nullptr;

  Impl() {
    cholmod_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
    common.quick_return_if_not_posdef = 1;
  }
  ~Impl() {
    cholmod_free_factor(&factor, &common);
    cholmod_free_sparse(&matrix, &common);
    cholmod_finish(&common);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  // Lower triangle, columns. Block column i of the lower triangle is block row i of the upper one.
  void buildPattern(const fem::BlockMatrix& A) {
    const int n = 3 * A.numNodes();
    std::size_t nnz = 0;
    for (int i = 0; i < A.numNodes(); ++i) {
      const int right_of_diagonal = A.rowEnd(i) - A.diagonal(i) - 1;
      nnz += 6 + 9 * static_cast<std::size_t>(right_of_diagonal);
    }
    matrix = cholmod_allocate_sparse(n, n, nnz, 1, 1, -1, CHOLMOD_REAL, &common);
    auto* start = static_cast<int*>(matrix->p);
    auto* row = static_cast<int*>(matrix->i);
    int next = 0;
    for (int i = 0; i < A.numNodes(); ++i) {
      for (int c = 0; c < 3; ++c) {
        start[3 * i + c] = next;
        for (int slot = A.diagonal(i); slot < A.rowEnd(i); ++slot) {
          const int first = slot == A.diagonal(i) ? c : 0;
          for (int r = first; r < 3; ++r) row[next++] = 3 * A.column(slot) + r;
        }
      }
    }
    start[n] = next;
  }

  void copyValues(const fem::BlockMatrix& A) {
    auto* value = static_cast<double*>(matrix->x);
    for (int i = 0; i < A.numNodes(); ++i) {
      for (int c = 0; c < 3; ++c) {
        for (int slot = A.diagonal(i); slot < A.rowEnd(i); ++slot) {
          const auto block = A.block(slot);  // rows of node i, columns of node j: transposed below
          const int first = slot == A.diagonal(i) ? c : 0;
          for (int r = first; r < 3; ++r) *value++ = block(c, r);
        }
      }
    }
  }
};

CholmodSolver::CholmodSolver() : impl_(std::make_unique<Impl>()) {}
CholmodSolver::~CholmodSolver() = default;

LinearReport CholmodSolver::solve(const fem::BlockMatrix& A, const Points& b, double, Points* x) {
  cholmod_common* common = &impl_->common;
  if (!b.allFinite()) return {SolveStatus::kNonFinite, 0};
  if (!impl_->matrix) {
    impl_->buildPattern(A);
    impl_->factor = cholmod_analyze(impl_->matrix, common);
  }
  impl_->copyValues(A);
  const auto* values = static_cast<const double*>(impl_->matrix->x);
  const Eigen::Map<const Eigen::VectorXd> all(values, impl_->matrix->nzmax);
  if (!all.allFinite()) return {SolveStatus::kNonFinite, 0};
  cholmod_factorize(impl_->matrix, impl_->factor, common);
  if (common->status == CHOLMOD_NOT_POSDEF || impl_->factor->minor < impl_->factor->n) {
    return {SolveStatus::kNotPositiveDefinite, 0};
  }

  cholmod_dense right = {};
  right.nrow = right.nzmax = right.d = static_cast<std::size_t>(b.size());
  right.ncol = 1;
  right.x = const_cast<double*>(b.data());  // CHOLMOD does not write to it
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, impl_->factor, &right, common);
  if (!solution) return {SolveStatus::kNonFinite, 0};
  *x = Eigen::Map<const Points>(static_cast<const double*>(solution->x), 3, b.cols());
  cholmod_free_dense(&solution, common);
  return {x->allFinite() ? SolveStatus::kConverged : SolveStatus::kNonFinite, 0};
}

}  // namespace palpate::solver
