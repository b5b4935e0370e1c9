// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/law.h"

namespace palpate::material {

/// Neo-Hookean solid in isochoric-volumetric form [Holzapfel 2000, eqs. 6.85, 6.96-6.103, 6.137]:
///
///   psi = mu/2 (J^(-2/3) I1 - 3) + kappa/2 (J - 1)^2,   I1 = tr F^T F,   J = det F
///
/// Infinite energy for J <= 0, where line searches reject it.
class NeoHookean : public FiniteStrainLaw {
 public:
  static constexpr std::string_view kName = "neo_hookean";
  static std::vector<std::string> constantNames() { return modulusNames(); }
  static Constants example() { return {{"mu", {2.0e3}}, {"kappa", {1.0e4}}}; }

  /// @throws std::invalid_argument, see readModuli().
  explicit NeoHookean(const Constants& constants) : moduli_(readModuli(constants)) {}

  Moduli moduli() const { return moduli_; }

  /// mu/2 (J^(-2/3) I1 - 3) [J/m^3].
  double distortionalEnergy(const Mat3& F) const {
    const double J = F.determinant();
    if (!(J > 0.0)) return std::numeric_limits<double>::infinity();
    return 0.5 * moduli_.mu * (F.squaredNorm() / std::cbrt(J * J) - 3.0);
  }

  /// mu J^(-2/3) (F - I1/(3 J) cof F) [Pa].
  Mat3 distortionalStress(const Mat3& F) const {
    const double J = F.determinant();
    const double a = moduli_.mu / std::cbrt(J * J);
    return a * F - a * F.squaredNorm() / (3.0 * J) * cofactor(F);
  }

  /// The derivative of vec(distortionalStress) by vec(F) [Pa], 9 x 9, symmetric.
  Mat9 distortionalTangent(const Mat3& F) const {
    const double J = F.determinant();
    const double a = moduli_.mu / std::cbrt(J * J);
    const double I1 = F.squaredNorm();
    const Mat3 cof = cofactor(F);
    const Vec9 c = vec(cof), f = vec(F);
    Mat9 K = 5.0 / 9.0 * a * I1 / (J * J) * c * c.transpose();
    K -= 2.0 / 3.0 * a / J * (f * c.transpose() + c * f.transpose());
    K.diagonal().array() += a;
    addCofactorDerivative(F, -a * I1 / (3.0 * J), &K);
    return K;
  }

 private:
  Moduli moduli_;  // [Pa]
};

}  // namespace palpate::material
