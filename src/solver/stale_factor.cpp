// SPDX-License-Identifier: GPL-3.0-or-later
#include "stale_factor.h"

#include <Eigen/Eigenvalues>

namespace palpate::solver {
namespace {

// Blocks with smaller relative change are not scaled: iterations and secant pairs handle small
// changes better than a scaling that ignores neighbours.
constexpr double kSmallChange = 0.5;

using Eigen3 = Eigen::SelfAdjointEigenSolver<Mat3>;

// Symmetric S with S F S = A, F and A positive definite: the geometric mean of A and F^-1 [Bhatia
// 2007, sec. 4.1]. Among all S with S F S^T = A it rotates least. Returns false if F or A is not
// positive definite.
bool scaleBetween(const Mat3& F, const Mat3& A, Mat3* inverse_scale) {
  const Eigen3 of_F(F);
  if (!(of_F.eigenvalues().minCoeff() > 0.0)) return false;
  const Mat3 root = of_F.operatorSqrt();
  const Eigen3 of_A(root * A * root);
  if (!(of_A.eigenvalues().minCoeff() > 0.0)) return false;
  *inverse_scale = root * of_A.operatorInverseSqrt() * root;
  return true;
}

}  // namespace

SolveStatus StaleFactor::factorize(const fem::Stiffness& A) {
  const SolveStatus status = factor_.factorize(A);
  ready_ = status == SolveStatus::kConverged;
  if (!ready_) return status;
  matrix_ = A;
  A.diagonal(&diagonal_);
  inverse_scale_.assign(diagonal_.size(), Mat3::Identity());
  return status;
}

void StaleFactor::save(StateWriter* out) const {
  out->put(ready_);
  if (ready_) matrix_.save(out);
}

void StaleFactor::restore(StateReader* in) {
  in->get(&ready_);
  if (!ready_) return;
  ready_ = false;
  matrix_.restore(in);
  if (factorize(fem::Stiffness(matrix_)) != SolveStatus::kConverged) StateReader::fail();
}

bool StaleFactor::scaleTo(const std::vector<Mat3>& diagonal) {
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    const Mat3 change = diagonal[i] - diagonal_[i];
    if (change.squaredNorm() <= kSmallChange * kSmallChange * diagonal_[i].squaredNorm()) {
      inverse_scale_[i].setIdentity();
    } else if (!scaleBetween(diagonal_[i], diagonal[i], &inverse_scale_[i])) {
      return false;
    }
  }
  return true;
}

bool StaleFactor::apply(const Points& r, Points* z) {
  scaled_.resize(3, r.cols());
  for (Eigen::Index i = 0; i < r.cols(); ++i) {
    scaled_.col(i).noalias() = inverse_scale_[i] * r.col(i);
  }
  if (factor_.solve(scaled_, z) != SolveStatus::kConverged) return false;
  for (Eigen::Index i = 0; i < r.cols(); ++i) {
    z->col(i) = (inverse_scale_[i] * z->col(i)).eval();
  }
  return true;
}

}  // namespace palpate::solver
