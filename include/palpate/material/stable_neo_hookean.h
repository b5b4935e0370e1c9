// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/constants.h"
#include "palpate/material/tensor.h"

namespace palpate::material {

/// Stable neo-Hookean solid without the log barrier [Smith, de Goes, Kim 2018, eq. 13]:
///
///   psi = mu/2 (I1 - 3) - mu (J - 1) + lambda'/2 (J - 1)^2,   I1 = tr F^T F,   J = det F
///
/// lambda' = lambda + mu, so that small strains obey Hooke's law with the given constants.
/// Defined for every F, inverted elements included.
class StableNeoHookean {
 public:
  static constexpr std::string_view kName = "stable_neo_hookean";
  static std::vector<std::string> constantNames() { return modulusNames(); }

  /// @throws std::invalid_argument, see readModuli().
  explicit StableNeoHookean(const Constants& constants) : moduli_(readModuli(constants)) {}

  Moduli moduli() const { return moduli_; }

  /// psi [J/m^3].
  double energyDensity(const Mat3& F) const {
    const double dJ = F.determinant() - 1.0;
    return 0.5 * moduli_.mu * (F.squaredNorm() - 3.0) - moduli_.mu * dJ +
           0.5 * lambdaPrime() * dJ * dJ;
  }

  /// P = mu F + (lambda' (J - 1) - mu) cof F [Pa].
  Mat3 firstPiolaKirchhoff(const Mat3& F) const {
    return moduli_.mu * F + (lambdaPrime() * (F.determinant() - 1.0) - moduli_.mu) * cofactor(F);
  }

  /// d vec(P)/d vec(F) [Pa], 9 x 9, symmetric; indefinite for large compression.
  Mat9 tangent(const Mat3& F) const {
    const Mat3 cof = cofactor(F);
    Mat9 K = lambdaPrime() * vec(cof) * vec(cof).transpose();
    K.diagonal().array() += moduli_.mu;
    addCofactorDerivative(F, lambdaPrime() * (F.determinant() - 1.0) - moduli_.mu, &K);
    return K;
  }

 private:
  double lambdaPrime() const { return moduli_.lambda() + moduli_.mu; }

  Moduli moduli_;  // [Pa]
};

}  // namespace palpate::material
