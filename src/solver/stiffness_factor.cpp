// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/stiffness_factor.h"

#include <cholmod.h>

#include <stdexcept>

#include "cholmod_matrix.h"

namespace palpate::solver {

struct StiffnessFactor::Impl {
  mutable cholmod_common common;
  std::unique_ptr<CholmodMatrix> matrix;
  cholmod_factor* factor = nullptr;

  Impl() {
    cholmod_start(&common);
    common.print = 0;
    common.error_handler = nullptr;
  }
  ~Impl() {
    cholmod_free_factor(&factor, &common);
    matrix.reset();
    cholmod_finish(&common);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
};

StiffnessFactor::StiffnessFactor(const fem::Stiffness& A) : impl_(std::make_unique<Impl>()) {
  cholmod_common* common = &impl_->common;
  impl_->matrix = makeCholmodMatrix(A, Volumes::kIncluded, common);
  impl_->matrix->assign(A);
  // Pressures as unknowns make the system quasi-definite: L D L^T.
  if (impl_->matrix->numPressures() > 0) {
    common->supernodal = CHOLMOD_SIMPLICIAL;
    common->final_ll = 0;
  }
  impl_->factor = cholmod_analyze(impl_->matrix->sparse(), common);
  cholmod_factorize(impl_->matrix->sparse(), impl_->factor, common);
  if (common->status == CHOLMOD_NOT_POSDEF || impl_->factor->minor < impl_->factor->n) {
    throw std::runtime_error("the stiffness is not positive definite");
  }
  const Eigen::MatrixXd any = Eigen::MatrixXd::Ones(3 * static_cast<Eigen::Index>(A.numNodes()), 1);
  if (!solve(any).allFinite()) throw std::runtime_error("the stiffness is not finite");
}

StiffnessFactor::~StiffnessFactor() = default;

Eigen::MatrixXd StiffnessFactor::solve(const Eigen::MatrixXd& B) const {
  Eigen::MatrixXd padded =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(impl_->factor->n), B.cols());
  padded.topRows(B.rows()) = B;
  cholmod_dense right = {};
  right.nrow = right.d = impl_->factor->n;
  right.ncol = static_cast<std::size_t>(B.cols());
  right.nzmax = right.nrow * right.ncol;
  right.x = padded.data();
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, impl_->factor, &right, &impl_->common);
  if (!solution) throw std::bad_alloc();
  Eigen::MatrixXd X = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(solution->x),
                                                        padded.rows(), padded.cols())
                          .topRows(B.rows());
  cholmod_free_dense(&solution, &impl_->common);
  return X;
}

}  // namespace palpate::solver
