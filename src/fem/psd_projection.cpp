// SPDX-License-Identifier: GPL-3.0-or-later
#include "psd_projection.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "palpate/material/principal_stretches.h"

namespace palpate::fem {
namespace {

constexpr double kNoneToSpeakOf = 1e-10;  // negligible eigenvalue over the largest diagonal entry
constexpr double kIsEigenvector = 1e-10;  // tolerance of an eigenvector: |A v - lambda v| over the
                                          // largest diagonal entry

bool isPositive(const Mat9& A, double scale) {
  const Mat9 shifted = A + kNoneToSpeakOf * scale * Mat9::Identity();
  return Eigen::LLT<Mat9>(shifted).info() == Eigen::Success;
}

void projectByAll(Mat9* A) {
  const Eigen::SelfAdjointEigenSolver<Mat9> eigen(*A);
  *A = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
       eigen.eigenvectors().transpose();
}

// Columns: three stretch modes, then flip and twist modes.
Mat9 modesOf(const material::PrincipalStretches& p) {
  Mat9 modes;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    modes.col(i) = p.stretchMode(i);
    modes.col(3 + i) = p.flipMode(i, j);
    modes.col(6 + i) = p.twistMode(i, j);
  }
  return modes;
}

// Projects by modes that are eigenvectors, but for the coupled stretch modes. Returns false and
// leaves A if they are not.
bool projectByKnown(const Mat9& modes, double tolerance, Mat9* A) {
  const Mat9 moved = *A * modes;
  const auto d = modes.leftCols<3>();
  const Mat3 stretches = d.transpose() * moved.leftCols<3>();
  const Eigen::Matrix<double, 9, 3> off = moved.leftCols<3>() - d * stretches;
  if (!(off.cwiseAbs().maxCoeff() <= tolerance)) return false;
  std::array<double, 9> values{};
  for (int k = 3; k < 9; ++k) {
    values[k] = modes.col(k).dot(moved.col(k));
    const auto apart = (moved.col(k) - values[k] * modes.col(k)).cwiseAbs();
    if (!(apart.maxCoeff() <= tolerance)) return false;
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> of_stretches(stretches);
  for (int k = 0; k < 9; ++k) {
    const double value = k < 3 ? of_stretches.eigenvalues()[k] : values[k];
    if (!(value < 0.0)) continue;
    const Eigen::Matrix<double, 9, 1> v =
        k < 3 ? (d * of_stretches.eigenvectors().col(k)).eval() : modes.col(k).eval();
    A->noalias() += v * (-value * v).transpose();
  }
  return true;
}

}  // namespace

Projected projectToPositiveSemidefinite(const Mat3& F, Mat9* A) {
  if (!A->allFinite()) return Projected::kNothing;  // left to the caller's checks
  const double scale = A->diagonal().cwiseAbs().maxCoeff();
  if (isPositive(*A, scale)) return Projected::kNothing;
  const Mat9 modes = modesOf(material::principalStretches(F));
  if (projectByKnown(modes, kIsEigenvector * scale, A)) return Projected::kByKnown;
  projectByAll(A);
  return Projected::kByAll;
}

}  // namespace palpate::fem
