// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::material {

/// vec(A), column-major, as a view.
inline Eigen::Map<const Vec9> vec(const Mat3& A) { return Eigen::Map<const Vec9>(A.data()); }

/// cof F = d det F / d F; equals J F^-T, defined for singular F too.
inline Mat3 cofactor(const Mat3& F) {
  Mat3 c;
  c.col(0) = F.col(1).cross(F.col(2));
  c.col(1) = F.col(2).cross(F.col(0));
  c.col(2) = F.col(0).cross(F.col(1));
  return c;
}

/// [a]x, so that [a]x b = a x b.
inline Mat3 crossMatrix(const Vec3& a) {
  Mat3 A;
  A << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return A;
}

/// K += s d vec(cof F)/d vec(F), the second derivative of det F (9 x 9, symmetric).
inline void addCofactorDerivative(const Mat3& F, double s, Mat9* K) {
  for (int j = 0; j < 3; ++j) {
    const Mat3 A = s * crossMatrix(F.col(j));
    const int k = (j + 1) % 3, l = (j + 2) % 3;
    K->block<3, 3>(3 * k, 3 * l) -= A;  // col k of cof F is f_l x f_j
    K->block<3, 3>(3 * l, 3 * k) += A;  // col l of cof F is f_j x f_k
  }
}

}  // namespace palpate::material
