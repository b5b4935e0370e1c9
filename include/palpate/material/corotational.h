// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "palpate/material/law.h"
#include "palpate/material/principal_stretches.h"

namespace palpate::material {

/// Hooke's law in the stretch S of the polar decomposition F = R S [Sifakis, Barbic 2012; Smith,
/// de Goes, Kim 2019], with the exact tangent:
///
///   psi = mu |dev(S - I)|^2 + kappa/2 (tr S - 3)^2
///
/// Linear in the strain, whatever the rotation. Finite for every F, inverted elements included,
/// with R the nearest rotation; the stress jumps only where two stretches sum to zero.
class Corotational : public FiniteStrainLaw {
 public:
  using Dilatation = StretchTrace;
  static constexpr std::string_view kName = "corotational";
  static std::vector<std::string> constantNames() { return modulusNames(); }
  static Constants example() { return {{"mu", {2.0e3}}, {"kappa", {1.0e4}}}; }

  /// @throws std::invalid_argument, see readModuli().
  explicit Corotational(const Constants& constants) : moduli_(readModuli(constants)) {}

  Moduli moduli() const { return moduli_; }

  static PrincipalStretches kinematics(const Mat3& F) { return principalStretches(F); }

  /// mu |dev(S - I)|^2 [J/m^3].
  double distortionalEnergy(const PrincipalStretches& p) const {
    const Vec3 e = p.s.array() - 1.0;
    return moduli_.mu * (e.array() - e.mean()).matrix().squaredNorm();
  }

  /// 2 mu R dev(S - I) = 2 mu (F - R (tr S)/3) [Pa].
  Mat3 distortionalStress(const PrincipalStretches& p) const {
    const Vec3 e = p.s.array() - 1.0;
    const Vec3 deviatoric = e.array() - e.mean();
    return 2.0 * moduli_.mu * p.U * deviatoric.asDiagonal() * p.V.transpose();
  }

  /// The derivative of vec(distortionalStress) by vec(F) [Pa], 9 x 9, symmetric:
  /// 2 mu (1 - R R/3 - (tr S)/3 dR/dF).
  Mat9 distortionalTangent(const PrincipalStretches& p) const {
    const double mu = moduli_.mu;
    const Mat3 R = p.rotation();
    Mat9 K = -2.0 / 3.0 * mu * vec(R) * vec(R).transpose();
    K.diagonal().array() += 2.0 * mu;
    addRotationDerivative(p, -2.0 / 3.0 * mu * p.s.sum(), &K);
    return K;
  }

  double distortionalEnergy(const Mat3& F) const { return distortionalEnergy(kinematics(F)); }
  Mat3 distortionalStress(const Mat3& F) const { return distortionalStress(kinematics(F)); }
  Mat9 distortionalTangent(const Mat3& F) const { return distortionalTangent(kinematics(F)); }

 private:
  Moduli moduli_;  // [Pa]
};

}  // namespace palpate::material
