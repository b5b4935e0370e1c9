// SPDX-License-Identifier: GPL-3.0-or-later
#include "cholmod_factor.h"

namespace palpate::solver {

CholmodFactor::CholmodFactor(Volumes volumes) : volumes_(volumes) {
  cholmod_start(&common_);
  common_.print = 0;
  common_.error_handler = nullptr;
  common_.quick_return_if_not_posdef = 1;
}

CholmodFactor::~CholmodFactor() {
  cholmod_free_factor(&uncoupled_.factor, &common_);
  cholmod_free_factor(&coupled_.factor, &common_);
  cholmod_free_dense(&solution_, &common_);
  cholmod_free_dense(&work_y_, &common_);
  cholmod_free_dense(&work_e_, &common_);
  uncoupled_.matrix.reset();
  coupled_.matrix.reset();
  uncoupled_.ordered.reset();
  coupled_.ordered.reset();
  cholmod_finish(&common_);
}

void CholmodFactor::analyzeUncoupled(const fem::Stiffness& A) {
  uncoupled_.matrix = makeCholmodMatrix(A, volumes_, &common_);
  if (uncoupled_.matrix->numPressures() > 0) {
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.final_ll = 0;
  }
  takeFactor(&uncoupled_, cholmod_analyze(uncoupled_.matrix->sparse(), &common_));
  padded_.setZero(static_cast<Eigen::Index>(uncoupled_.matrix->sparse()->nrow));
  const auto* order = static_cast<const int*>(uncoupled_.factor->Perm);
  order_.assign(order, order + uncoupled_.factor->n);
  used_ = &uncoupled_;
}

// Stores the factor of the last analysis.
void CholmodFactor::takeFactor(Analysed* analysed, cholmod_factor* factor) {
  analysed->factor = factor;
  analysed->flops = common_.fl;
  analysed->nonzeros = common_.lnz;
  analysed->ordered.reset();
  if (!analysed->factor->is_super) return;
  analysed->ordered =
      std::make_unique<OrderedMatrix>(*analysed->matrix->sparse(), analysed->factor, &common_);
}

void CholmodFactor::analyze(const fem::Stiffness& A) {
  if (!uncoupled_.matrix) {
    fem::Stiffness alone = A;
    alone.forgetAdded();
    analyzeUncoupled(alone);
  }
  used_ = A.couplings().empty() ? &uncoupled_ : &coupled_;
  if (used_->matrix && used_->matrix->fits(A)) return;
  cholmod_free_factor(&coupled_.factor, &common_);
  coupled_.matrix = uncoupled_.matrix->coupled(A);
  const int methods = common_.nmethods, ordering = common_.method[0].ordering;
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_GIVEN;
  takeFactor(&coupled_,
             cholmod_analyze_p(coupled_.matrix->sparse(), order_.data(), nullptr, 0, &common_));
  common_.nmethods = methods;
  common_.method[0].ordering = ordering;
}

// A quasi-definite system has as many negative pivots as pressures if and only if A is positive
// definite [Sylvester's law of inertia]. CHOLMOD factors small matrices as L D L' and accepts
// pivots of either sign.
bool CholmodFactor::positiveDefinite() const {
  if (common_.status == CHOLMOD_NOT_POSDEF || used_->factor->minor < used_->factor->n) return false;
  if (used_->factor->is_ll) return true;
  int negative = 0;
  const auto* start = static_cast<const int*>(used_->factor->p);
  const auto* value = static_cast<const double*>(used_->factor->x);
  for (std::size_t k = 0; k < used_->factor->n; ++k) negative += value[start[k]] < 0.0 ? 1 : 0;
  return negative == used_->matrix->numPressures();
}

SolveStatus CholmodFactor::factorize(const fem::Stiffness& A) {
  analyze(A);
  used_->matrix->assign(A);
  cholmod_sparse* sparse = used_->matrix->sparse();
  const auto* values = static_cast<const double*>(sparse->x);
  const Eigen::Map<const Eigen::VectorXd> all(values, static_cast<Eigen::Index>(sparse->nzmax));
  if (!all.allFinite()) return SolveStatus::kNonFinite;
  if (used_->ordered) sparse = used_->ordered->ordered(*sparse);
  cholmod_factorize(sparse, used_->factor, &common_);
  return positiveDefinite() ? SolveStatus::kConverged : SolveStatus::kNotPositiveDefinite;
}

SolveStatus CholmodFactor::solve(const Points& b, Points* x) {
  const int* order = used_->ordered ? used_->ordered->order().data() : nullptr;
  for (Eigen::Index k = 0; k < b.size(); ++k) padded_[k] = b.data()[order ? order[k] : k];
  cholmod_dense right = {};
  right.nrow = right.nzmax = right.d = static_cast<std::size_t>(padded_.size());
  right.ncol = 1;
  right.x = padded_.data();
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  // Keeps its workspace between calls.
  if (!cholmod_solve2(CHOLMOD_A, used_->factor, &right, nullptr, &solution_, nullptr, &work_y_,
                      &work_e_, &common_)) {
    return SolveStatus::kNonFinite;
  }
  const auto* solution = static_cast<const double*>(solution_->x);
  x->resize(3, b.cols());
  for (Eigen::Index k = 0; k < b.size(); ++k) x->data()[order ? order[k] : k] = solution[k];
  return x->allFinite() ? SolveStatus::kConverged : SolveStatus::kNonFinite;
}

}  // namespace palpate::solver
