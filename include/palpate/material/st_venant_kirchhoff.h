// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/law.h"

namespace palpate::material {

/// St Venant-Kirchhoff solid, Hooke's law in the Green strain [Holzapfel 2000, eq. 6.151]:
///
///   psi = lambda/2 (tr E)^2 + mu tr E^2 = kappa/2 (tr E)^2 + mu |dev E|^2,   E = (F^T F - I)/2
///
/// Softens and collapses in compression; for comparisons, not for organs.
class StVenantKirchhoff : public FiniteStrainLaw {
 public:
  using Dilatation = GreenStrainTrace;
  static constexpr std::string_view kName = "st_venant_kirchhoff";
  static std::vector<std::string> constantNames() { return modulusNames(); }
  static Constants example() { return {{"mu", {2.0e3}}, {"kappa", {1.0e4}}}; }

  /// @throws std::invalid_argument, see readModuli().
  explicit StVenantKirchhoff(const Constants& constants) : moduli_(readModuli(constants)) {}

  Moduli moduli() const { return moduli_; }

  /// mu |dev E|^2 [J/m^3].
  double distortionalEnergy(const Mat3& F) const {
    return moduli_.mu * deviatoricGreenStrain(F).squaredNorm();
  }

  /// F S, S = 2 mu dev E [Pa].
  Mat3 distortionalStress(const Mat3& F) const {
    return 2.0 * moduli_.mu * F * deviatoricGreenStrain(F);
  }

  /// The derivative of vec(distortionalStress) by vec(F) [Pa], 9 x 9: geometric part S_jl delta_ik
  /// plus F dS.
  Mat9 distortionalTangent(const Mat3& F) const {
    const double mu = moduli_.mu;
    const Mat3 S = 2.0 * mu * deviatoricGreenStrain(F);
    const Mat3 B = F * F.transpose();
    Mat9 K = -2.0 / 3.0 * mu * vec(F) * vec(F).transpose();
    for (int j = 0; j < 3; ++j) {
      for (int l = 0; l < 3; ++l) {
        auto K_jl = K.block<3, 3>(3 * j, 3 * l);
        K_jl.diagonal().array() += S(j, l);
        K_jl += mu * F.col(l) * F.col(j).transpose();
        if (j == l) K_jl += mu * B;
      }
    }
    return K;
  }

 private:
  static Mat3 deviatoricGreenStrain(const Mat3& F) {
    const Mat3 E = 0.5 * (F.transpose() * F - Mat3::Identity());
    return E - E.trace() / 3.0 * Mat3::Identity();
  }

  Moduli moduli_;  // [Pa]
};

}  // namespace palpate::material
