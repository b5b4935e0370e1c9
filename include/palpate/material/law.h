// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/material/constants.h"
#include "palpate/material/dilatation.h"
#include "palpate/material/tensor.h"

namespace palpate::material {

/// Defaults of most laws: isotropic, for finite rotations and strains. A law derives from this and
/// hides what differs.
struct FiniteStrainLaw {
  /// Dilatation measure theta of the volumetric energy kappa/2 theta^2.
  using Dilatation = VolumeRatio;
  /// Whether the law has directions. F then maps from the material frame to the world frame; the
  /// first material axis is the fibre, the second the sheet.
  static constexpr bool kNeedsFibres = false;
  /// Whether psi(R F) = psi(F) for every rotation R.
  static constexpr bool kFrameIndifferent = true;
  /// Argument for several calls of energy, stress, tangent and dilatation at one F: F, or its
  /// decomposition for laws that decompose it.
  static const Mat3& kinematics(const Mat3& F) { return F; }
};

// Complete law from its two parts,
//     psi(F) = distortional energy(F) + kappa/2 theta(F)^2.

/// psi [J/m^3].
template <class Law>
double energyDensity(const Law& law, const Mat3& F) {
  const auto& of_F = law.kinematics(F);
  const double theta = Law::Dilatation::value(of_F);
  return law.distortionalEnergy(of_F) + 0.5 * law.moduli().kappa * theta * theta;
}

/// P = d psi / d F [Pa].
template <class Law>
Mat3 firstPiolaKirchhoff(const Law& law, const Mat3& F) {
  using Theta = typename Law::Dilatation;
  const auto& of_F = law.kinematics(F);
  return law.distortionalStress(of_F) +
         law.moduli().kappa * Theta::value(of_F) * Theta::gradient(of_F);
}

/// d vec(P)/d vec(F) [Pa], 9 x 9, symmetric.
template <class Law>
Mat9 tangent(const Law& law, const Mat3& F) {
  using Theta = typename Law::Dilatation;
  const auto& of_F = law.kinematics(F);
  const Mat3 gradient = Theta::gradient(of_F);
  const double kappa = law.moduli().kappa;
  Mat9 K = law.distortionalTangent(of_F);
  K += kappa * vec(gradient) * vec(gradient).transpose();
  Theta::addHessian(of_F, kappa * Theta::value(of_F), &K);
  return K;
}

}  // namespace palpate::material
