// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/constants.h"
#include "palpate/material/tensor.h"

namespace palpate::material {

/// St Venant-Kirchhoff solid, Hooke's law in the Green strain [Holzapfel 2000, eq. 6.151]:
///
///   psi = lambda/2 (tr E)^2 + mu tr E^2,   E = (F^T F - I)/2
///
/// Softens and finally collapses in compression; for comparisons, not for organs.
class StVenantKirchhoff {
 public:
  static constexpr std::string_view kName = "st_venant_kirchhoff";
  static std::vector<std::string> constantNames() { return modulusNames(); }

  /// @throws std::invalid_argument, see readModuli().
  explicit StVenantKirchhoff(const Constants& constants) : moduli_(readModuli(constants)) {}

  Moduli moduli() const { return moduli_; }

  /// psi [J/m^3].
  double energyDensity(const Mat3& F) const {
    const Mat3 E = greenStrain(F);
    const double trace = E.trace();
    return 0.5 * moduli_.lambda() * trace * trace + moduli_.mu * E.squaredNorm();
  }

  /// P = F S [Pa].
  Mat3 firstPiolaKirchhoff(const Mat3& F) const { return F * secondPiolaKirchhoff(F); }

  /// d vec(P)/d vec(F) [Pa], 9 x 9: geometric part S_jl delta_ik plus F dS.
  Mat9 tangent(const Mat3& F) const {
    const Mat3 S = secondPiolaKirchhoff(F);
    const Mat3 B = F * F.transpose();
    const double lambda = moduli_.lambda(), mu = moduli_.mu;
    Mat9 K = lambda * vec(F) * vec(F).transpose();
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
  static Mat3 greenStrain(const Mat3& F) { return 0.5 * (F.transpose() * F - Mat3::Identity()); }
  Mat3 secondPiolaKirchhoff(const Mat3& F) const {
    const Mat3 E = greenStrain(F);
    return moduli_.lambda() * E.trace() * Mat3::Identity() + 2.0 * moduli_.mu * E;
  }

  Moduli moduli_;  // [Pa]
};

}  // namespace palpate::material
