// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "palpate/base/types.h"

namespace palpate::material {

/// Von Mises stress of the Cauchy stress sigma, sqrt(3/2) |dev sigma| [Pa].
inline double vonMises(const Mat3& sigma) {
  return std::sqrt(1.5) * (sigma - sigma.trace() / 3.0 * Mat3::Identity()).norm();
}

/// Singular values of F, largest first.
inline Vec3 stretchesOf(const Mat3& F) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(F.transpose() * F, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().reverse();
}

/// Components xx yy zz xy yz zx of a symmetric tensor.
inline Eigen::Matrix<double, 6, 1> components(const Mat3& s) {
  Eigen::Matrix<double, 6, 1> c;
  c << s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(2, 0);
  return c;
}

}  // namespace palpate::material
