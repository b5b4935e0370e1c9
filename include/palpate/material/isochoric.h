// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>

#include "palpate/material/law.h"

namespace palpate::material {

/// A law whose distortional energy depends on the isochoric part of F only [Flory 1961],
///
///   psi = W(Fbar) + kappa/2 (J - 1)^2,   Fbar = J^(-1/3) F,   J = det F
///
/// Law derives from IsochoricLaw<Law> and provides W as a function of any F, with derivatives that
/// ignore the split:
///
///     double isochoricEnergy(const Mat3& Fbar) const;    W [J/m^3]
///     Mat3 isochoricStress(const Mat3& Fbar) const;      dW/dFbar [Pa]
///     Mat9 isochoricTangent(const Mat3& Fbar) const;     its second derivative by vec Fbar [Pa]
///
/// The energy is infinite for J <= 0, where line searches reject it, and on overflow of W.
template <class Law>
class IsochoricLaw : public FiniteStrainLaw {
 public:
  /// W(Fbar) [J/m^3].
  double distortionalEnergy(const Mat3& F) const {
    const double J = F.determinant();
    if (!(J > 0.0)) return std::numeric_limits<double>::infinity();
    const double W = law().isochoricEnergy(F / std::cbrt(J));
    return std::isfinite(W) ? W : std::numeric_limits<double>::infinity();
  }

  /// J^(-1/3) (S - 1/3 (S : F) F^-T) with S = dW/dFbar [Pa].
  Mat3 distortionalStress(const Mat3& F) const {
    const double J = F.determinant();
    const double s = 1.0 / std::cbrt(J);
    const Mat3 S = law().isochoricStress(s * F);
    return s * S - s / (3.0 * J) * S.cwiseProduct(F).sum() * cofactor(F);
  }

  /// With G = dFbar/dF: G^T (d2W/dFbar2) G + S : d2Fbar/dF2 [Pa], 9 x 9, symmetric.
  Mat9 distortionalTangent(const Mat3& F) const {
    const double J = F.determinant();
    const double s = 1.0 / std::cbrt(J);
    const Mat3 stress = law().isochoricStress(s * F);
    Mat9 K = law().isochoricTangent(s * F);
    const Mat3 inverse_transpose = cofactor(F) / J;
    const Vec9 f = vec(F), c = vec(inverse_transpose), S = s * vec(stress);
    const Vec9 Df = s * s * (K * f);
    const double fDf = f.dot(Df), Sf = S.dot(f);
    // All terms but d2W and the second derivative of J have the form c u^T + u c^T.
    const Vec9 u = (fDf / 18.0 + 2.0 / 9.0 * Sf) * c - 1.0 / 3.0 * (Df + S);
    K *= s * s;
    K += c * u.transpose();
    K += u * c.transpose();
    addCofactorDerivative(F, -Sf / (3.0 * J), &K);
    return K;
  }

 private:
  const Law& law() const { return static_cast<const Law&>(*this); }
};

}  // namespace palpate::material
