// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/constants.h"
#include "palpate/material/tensor.h"

namespace palpate::material {

/// Neo-Hookean solid in isochoric-volumetric form [Holzapfel 2000, eqs. 6.85, 6.96-6.103, 6.137]:
///
///   psi = mu/2 (J^(-2/3) I1 - 3) + kappa/2 (J - 1)^2,   I1 = tr F^T F,   J = det F
///
/// Infinite energy for J <= 0, which a line search never enters.
class NeoHookean {
 public:
  static constexpr std::string_view kName = "neo_hookean";
  static std::vector<std::string> constantNames() { return modulusNames(); }

  /// @throws std::invalid_argument, see readModuli().
  explicit NeoHookean(const Constants& constants) : moduli_(readModuli(constants)) {}

  Moduli moduli() const { return moduli_; }

  /// psi [J/m^3].
  double energyDensity(const Mat3& F) const {
    const double J = F.determinant();
    if (!(J > 0.0)) return std::numeric_limits<double>::infinity();
    return 0.5 * moduli_.mu * (F.squaredNorm() / std::cbrt(J * J) - 3.0) +
           0.5 * moduli_.kappa * (J - 1.0) * (J - 1.0);
  }

  /// P = mu J^(-2/3) (F - I1/(3 J) cof F) + kappa (J - 1) cof F [Pa].
  Mat3 firstPiolaKirchhoff(const Mat3& F) const {
    const double J = F.determinant();
    const double a = moduli_.mu / std::cbrt(J * J);
    return a * F + (moduli_.kappa * (J - 1.0) - a * F.squaredNorm() / (3.0 * J)) * cofactor(F);
  }

  /// d vec(P)/d vec(F) [Pa], 9 x 9, symmetric.
  Mat9 tangent(const Mat3& F) const {
    const double J = F.determinant();
    const double a = moduli_.mu / std::cbrt(J * J);
    const double I1 = F.squaredNorm();
    const Mat3 cof = cofactor(F);
    const Vec9 c = vec(cof), f = vec(F);
    Mat9 K = (moduli_.kappa + 5.0 / 9.0 * a * I1 / (J * J)) * c * c.transpose();
    K -= 2.0 / 3.0 * a / J * (f * c.transpose() + c * f.transpose());
    K.diagonal().array() += a;
    addCofactorDerivative(F, moduli_.kappa * (J - 1.0) - a * I1 / (3.0 * J), &K);
    return K;
  }

 private:
  Moduli moduli_;  // [Pa]
};

}  // namespace palpate::material
