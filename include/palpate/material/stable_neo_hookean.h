// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/law.h"

namespace palpate::material {

/// Stable neo-Hookean solid without the log barrier [Smith, de Goes, Kim 2018, eq. 13]:
///
///   psi = mu/2 (I1 - 3) - mu (J - 1) + lambda'/2 (J - 1)^2,   I1 = tr F^T F,   J = det F
///
/// lambda' = lambda + mu = kappa + mu/3, so that small strains obey Hooke's law; its part kappa is
/// volumetric. Defined for every F, also inverted.
class StableNeoHookean : public FiniteStrainLaw {
 public:
  static constexpr std::string_view kName = "stable_neo_hookean";
  static std::vector<std::string> constantNames() { return modulusNames(); }
  static Constants example() { return {{"mu", {2.0e3}}, {"kappa", {1.0e4}}}; }

  /// @throws std::invalid_argument, see readModuli().
  explicit StableNeoHookean(const Constants& constants) : moduli_(readModuli(constants)) {}

  Moduli moduli() const { return moduli_; }

  /// mu/2 (I1 - 3) - mu (J - 1) + mu/6 (J - 1)^2 [J/m^3].
  double distortionalEnergy(const Mat3& F) const {
    const double dJ = F.determinant() - 1.0;
    return moduli_.mu * (0.5 * (F.squaredNorm() - 3.0) - dJ + dJ * dJ / 6.0);
  }

  /// mu F + mu ((J - 1)/3 - 1) cof F [Pa].
  Mat3 distortionalStress(const Mat3& F) const {
    return moduli_.mu * (F + pressureFactor(F) * cofactor(F));
  }

  /// The derivative of vec(distortionalStress) by vec(F) [Pa], 9 x 9, symmetric; indefinite for
  /// large compression.
  Mat9 distortionalTangent(const Mat3& F) const {
    const Mat3 cof = cofactor(F);
    Mat9 K = moduli_.mu / 3.0 * vec(cof) * vec(cof).transpose();
    K.diagonal().array() += moduli_.mu;
    addCofactorDerivative(F, moduli_.mu * pressureFactor(F), &K);
    return K;
  }

 private:
  static double pressureFactor(const Mat3& F) { return (F.determinant() - 1.0) / 3.0 - 1.0; }

  Moduli moduli_;  // [Pa]
};

}  // namespace palpate::material
