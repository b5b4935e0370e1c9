// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/law.h"

namespace palpate::material {

/// Hooke's law in small strain [Holzapfel 2000, section 6]:
///
///   psi = mu |dev eps|^2 + kappa/2 (tr eps)^2,   eps = (F + F^T)/2 - I
///
/// For small strains and small rotations: rotation causes stress. For comparisons with closed
/// forms; Corotational has the same stiffness at large rotations.
class Linear : public FiniteStrainLaw {
 public:
  using Dilatation = SmallStrainTrace;
  static constexpr bool kFrameIndifferent = false;
  static constexpr std::string_view kName = "linear";
  static std::vector<std::string> constantNames() { return modulusNames(); }
  static Constants example() { return {{"mu", {2.0e3}}, {"kappa", {1.0e4}}}; }

  /// @throws std::invalid_argument, see readModuli().
  explicit Linear(const Constants& constants) : moduli_(readModuli(constants)) {}

  Moduli moduli() const { return moduli_; }

  /// mu |dev eps|^2 [J/m^3].
  double distortionalEnergy(const Mat3& F) const {
    return moduli_.mu * deviatoricStrain(F).squaredNorm();
  }

  /// 2 mu dev eps [Pa].
  Mat3 distortionalStress(const Mat3& F) const { return 2.0 * moduli_.mu * deviatoricStrain(F); }

  /// The derivative of vec(distortionalStress) by vec(F) [Pa], 9 x 9, constant.
  Mat9 distortionalTangent(const Mat3&) const {
    const double mu = moduli_.mu;
    const Mat3 I = Mat3::Identity();
    Mat9 K = -2.0 / 3.0 * mu * vec(I) * vec(I).transpose();
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) {
        K(3 * j + i, 3 * j + i) += mu;  // F_ij
        K(3 * j + i, 3 * i + j) += mu;  // F_ji
      }
    }
    return K;
  }

 private:
  static Mat3 deviatoricStrain(const Mat3& F) {
    const Mat3 strain = 0.5 * (F + F.transpose()) - Mat3::Identity();
    return strain - strain.trace() / 3.0 * Mat3::Identity();
  }

  Moduli moduli_;  // [Pa]
};

}  // namespace palpate::material
