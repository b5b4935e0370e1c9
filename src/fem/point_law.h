// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/material/law.h"

namespace palpate::fem {

/// A law at an integration point, with what the element and its past add to it:
///
///   psi = factor psi_dist(F) + kappa/2 theta^2 + pressure theta + 1/2 H : (F^T F - I)
///
/// kappa is the part of the bulk modulus that the element itself carries; `pressure` is held.
template <class Law>
struct PointLaw {
  const Law& law;
  double factor;    ///< Of the distortional energy, see PronyHistory.
  double kappa;     ///< [Pa]
  double pressure;  ///< [Pa]
  const Mat3* H;    ///< [Pa], or null.

  using Theta = typename Law::Dilatation;

  /// Without pressure theta, which is counted at the nodes [J/m^3].
  double energyDensity(const Mat3& F) const {
    double psi = factor * law.distortionalEnergy(F);
    if (kappa != 0.0) {
      const double theta = Theta::value(F);
      psi += 0.5 * kappa * theta * theta;
    }
    if (H) psi += 0.5 * (H->cwiseProduct(F.transpose() * F).sum() - H->trace());
    return psi;
  }

  Mat3 firstPiolaKirchhoff(const Mat3& F) const {
    Mat3 P = factor * law.distortionalStress(F);
    P += (kappa * Theta::value(F) + pressure) * Theta::gradient(F);
    if (H) P += F * *H;
    return P;
  }

  Mat9 tangent(const Mat3& F) const {
    Mat9 C = factor * law.distortionalTangent(F);
    if (kappa != 0.0) {
      const Mat3 gradient = Theta::gradient(F);
      C += kappa * material::vec(gradient) * material::vec(gradient).transpose();
    }
    Theta::addHessian(F, kappa * Theta::value(F) + pressure, &C);
    if (H) {
      for (int j = 0; j < 3; ++j) {
        for (int l = 0; l < 3; ++l) {
          C.template block<3, 3>(3 * j, 3 * l).diagonal().array() += (*H)(j, l);
        }
      }
    }
    return C;
  }
};

}  // namespace palpate::fem
