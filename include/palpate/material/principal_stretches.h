// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "palpate/material/tensor.h"

namespace palpate::material {

/// Singular value decomposition F = U diag(s) V^T with rotations U, V and s0 >= s1 >= |s2|; s2 has
/// the sign of det F. The s are the principal stretches.
struct PrincipalStretches {
  Mat3 U = Mat3::Identity();
  Mat3 V = Mat3::Identity();
  Vec3 s = Vec3::Zero();

  /// Rotation R nearest to F = R S, with S = V diag(s) V^T. R is not unique for s1 + s2 = 0.
  Mat3 rotation() const { return U * V.transpose(); }

  /// Orthonormal basis of 3 x 3 matrices as vec(): u_i v_i^T, and for i != j the flip and twist
  /// modes, which change the frames of F but not its stretches.
  Vec9 stretchMode(int i) const { return mode(i, i); }
  Vec9 flipMode(int i, int j) const { return std::sqrt(0.5) * (mode(i, j) + mode(j, i)); }
  Vec9 twistMode(int i, int j) const { return std::sqrt(0.5) * (mode(i, j) - mode(j, i)); }

 private:
  Vec9 mode(int i, int j) const {
    const Mat3 m = U.col(i) * V.col(j).transpose();
    return vec(m);
  }
};

/// One-sided Jacobi iteration [Hestenes 1958]: rotates pairs of columns of F V until they are
/// orthogonal to round-off. For every finite F, also singular or inverted.
inline PrincipalStretches principalStretches(const Mat3& F) {
  constexpr int kPairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
  constexpr int kNeighbours[3][2] = {{0, 1}, {1, 2}, {0, 1}};
  constexpr int kMaxSweeps = 20;  // a handful suffices
  constexpr double kOrthogonal = 1e-15;

  PrincipalStretches p;
  const double size = F.cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return p;
  Mat3 A = F / size;  // prevents overflow of squares
  const auto turn = [](Mat3* M, int i, int j, double c, double s) {
    const Vec3 old = M->col(i);
    M->col(i) = c * old - s * M->col(j);
    M->col(j) = s * old + c * M->col(j);
  };
  for (int sweep = 0, turned = 1; turned > 0 && sweep < kMaxSweeps; ++sweep) {
    turned = 0;
    for (const auto& [i, j] : kPairs) {
      const double ii = A.col(i).squaredNorm(), jj = A.col(j).squaredNorm();
      const double ij = A.col(i).dot(A.col(j));
      if (!(std::abs(ij) > kOrthogonal * std::sqrt(ii * jj))) continue;
      const double zeta = (jj - ii) / (2.0 * ij);
      const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::sqrt(1.0 + zeta * zeta));
      const double c = 1.0 / std::sqrt(1.0 + t * t);
      turn(&A, i, j, c, c * t);
      turn(&p.V, i, j, c, c * t);
      ++turned;
    }
  }

  // Sorts columns by length; a quarter turn swaps two, so V stays a rotation.
  for (const auto& [i, j] : kNeighbours) {
    if (A.col(i).squaredNorm() >= A.col(j).squaredNorm()) continue;
    turn(&A, i, j, 0.0, 1.0);
    turn(&p.V, i, j, 0.0, 1.0);
  }

  // U from the columns, orthogonal even for vanishing columns.
  const double longest = A.col(0).norm();
  p.U.col(0) = A.col(0) / longest;
  const Vec3 second = A.col(1) - p.U.col(0).dot(A.col(1)) * p.U.col(0);
  p.U.col(1) = second.norm() > 1e-15 * longest ? Vec3(second.normalized())
                                               : Vec3(p.U.col(0).unitOrthogonal());
  p.U.col(2) = p.U.col(0).cross(p.U.col(1));
  p.s = size * Vec3(longest, A.col(1).norm(), p.U.col(2).dot(A.col(2)));
  return p;
}

/// Adds s dR/d vec F, 9 x 9, symmetric, to K, with R = rotation(). The derivative is the sum over
/// i < j of 2/(s_i + s_j) m m^T, m being the twist mode. R jumps where two stretches sum to zero;
/// sums below 1e-6 count as 1e-6.
inline void addRotationDerivative(const PrincipalStretches& p, double s, Mat9* K) {
  constexpr double kSmallestSum = 1e-6;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const Vec9 twist = p.twistMode(i, j);
    *K += s * 2.0 / std::max(p.s(i) + p.s(j), kSmallestSum) * twist * twist.transpose();
  }
}

}  // namespace palpate::material
