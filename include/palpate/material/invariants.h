// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/material/isochoric.h"
#include "palpate/material/tensor.h"

namespace palpate::material {

/// First and second derivatives [Pa] of an energy W(I1, I2), I1 = tr C = |F|^2, I2 = (I1^2 - tr
/// C^2)/2 = |cof F|^2, C = F^T F. For an energy of I1 alone, the others are zero and cost nothing.
struct InvariantDerivatives {
  double w1 = 0.0, w2 = 0.0;
  double w11 = 0.0, w12 = 0.0, w22 = 0.0;

  bool usesSecond() const { return w2 != 0.0 || w12 != 0.0 || w22 != 0.0; }
};

/// dI2/dF = 2 (I1 F - F C).
inline Mat3 secondInvariantGradient(const Mat3& F) {
  return 2.0 * (F.squaredNorm() * F - F * (F.transpose() * F));
}

/// dW/dF = 2 w1 F + w2 dI2/dF [Pa].
inline Mat3 invariantStress(const InvariantDerivatives& d, const Mat3& F) {
  Mat3 P = 2.0 * d.w1 * F;
  if (d.usesSecond()) P += d.w2 * secondInvariantGradient(F);
  return P;
}

/// K += s d2 I2/d vec F^2 (9 x 9, symmetric).
inline void addSecondInvariantHessian(const Mat3& F, double s, Mat9* K) {
  const Mat3 C = F.transpose() * F;
  const Mat3 B = F * F.transpose();
  *K += 4.0 * s * vec(F) * vec(F).transpose();
  K->diagonal().array() += 2.0 * s * C.trace();
  for (int j = 0; j < 3; ++j) {
    for (int l = 0; l < 3; ++l) {
      auto K_jl = K->block<3, 3>(3 * j, 3 * l);
      K_jl.diagonal().array() -= 2.0 * s * C(j, l);
      K_jl -= 2.0 * s * F.col(l) * F.col(j).transpose();
      if (j == l) K_jl -= 2.0 * s * B;
    }
  }
}

/// d2 W/d vec F^2 [Pa].
inline Mat9 invariantTangent(const InvariantDerivatives& d, const Mat3& F) {
  const Vec9 g1 = 2.0 * vec(F);
  Mat9 K = d.w11 * g1 * g1.transpose();
  K.diagonal().array() += 2.0 * d.w1;
  if (!d.usesSecond()) return K;
  const Mat3 gradient2 = secondInvariantGradient(F);
  const Vec9 g2 = vec(gradient2);
  K += d.w12 * (g1 * g2.transpose() + g2 * g1.transpose());
  K += d.w22 * g2 * g2.transpose();
  addSecondInvariantHessian(F, d.w2, &K);
  return K;
}

/// A law W(I1bar, I2bar) of the invariants of Fbar. Law derives from InvariantLaw<Law> and
/// provides, by x1 = I1bar - 3 and x2 = I2bar - 3,
///
///     double energy(double x1, double x2) const;                        W [J/m^3]
///     InvariantDerivatives derivatives(double x1, double x2) const;     [Pa]
template <class Law>
class InvariantLaw : public IsochoricLaw<Law> {
 public:
  double isochoricEnergy(const Mat3& F) const { return law().energy(x1(F), x2(F)); }
  Mat3 isochoricStress(const Mat3& F) const {
    return invariantStress(law().derivatives(x1(F), x2(F)), F);
  }
  Mat9 isochoricTangent(const Mat3& F) const {
    return invariantTangent(law().derivatives(x1(F), x2(F)), F);
  }

 private:
  static double x1(const Mat3& F) { return F.squaredNorm() - 3.0; }
  static double x2(const Mat3& F) { return cofactor(F).squaredNorm() - 3.0; }
  const Law& law() const { return static_cast<const Law&>(*this); }
};

}  // namespace palpate::material
