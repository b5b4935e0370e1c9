// SPDX-License-Identifier: GPL-3.0-or-later
#include "psd_projection.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace palpate::fem {

void projectToPositiveSemidefinite(Mat9* A) {
  if (!A->allFinite()) return;  // for the caller's own checks
  const double shift = 1e-10 * A->diagonal().cwiseAbs().maxCoeff();
  const Mat9 shifted = *A + shift * Mat9::Identity();
  if (Eigen::LLT<Mat9>(shifted).info() == Eigen::Success) return;
  const Eigen::SelfAdjointEigenSolver<Mat9> eigen(*A);
  *A = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
       eigen.eigenvectors().transpose();
}

}  // namespace palpate::fem
