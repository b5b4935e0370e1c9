// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/material/constants.h"
#include "palpate/material/dilatation.h"
#include "palpate/material/tensor.h"

namespace palpate::material {

/// What most laws are: isotropic, for finite rotations and strains. A law derives from this and
/// hides what differs.
struct FiniteStrainLaw {
  /// The volumetric energy is kappa/2 theta^2 with this theta.
  using Dilatation = VolumeRatio;
  /// The law has directions: F is to be given from the material frame, whose first axis is the
  /// fibre (and whose second the sheet), to the world.
  static constexpr bool kNeedsFibres = false;
  /// psi(R F) = psi(F) for every rotation R.
  static constexpr bool kFrameIndifferent = true;
};

// A whole law from its two parts,
//     psi(F) = distortional energy(F) + kappa/2 theta(F)^2.

/// psi [J/m^3].
template <class Law>
double energyDensity(const Law& law, const Mat3& F) {
  const double theta = Law::Dilatation::value(F);
  return law.distortionalEnergy(F) + 0.5 * law.moduli().kappa * theta * theta;
}

/// P = d psi / d F [Pa].
template <class Law>
Mat3 firstPiolaKirchhoff(const Law& law, const Mat3& F) {
  using Theta = typename Law::Dilatation;
  return law.distortionalStress(F) + law.moduli().kappa * Theta::value(F) * Theta::gradient(F);
}

/// d vec(P)/d vec(F) [Pa], 9 x 9, symmetric.
template <class Law>
Mat9 tangent(const Law& law, const Mat3& F) {
  using Theta = typename Law::Dilatation;
  const Mat3 gradient = Theta::gradient(F);
  const double kappa = law.moduli().kappa;
  Mat9 K = law.distortionalTangent(F);
  K += kappa * vec(gradient) * vec(gradient).transpose();
  Theta::addHessian(F, kappa * Theta::value(F), &K);
  return K;
}

}  // namespace palpate::material
