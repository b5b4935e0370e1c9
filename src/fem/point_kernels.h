// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/material/material.h"

namespace palpate::fem {

/// Integration points of one solid, with what the element and its past add to the law:
///
///   psi = factor psi_dist(F) + kappa/2 theta^2 + pressure theta + 1/2 H : (F^T F - I)
///
/// kappa is the part of the bulk modulus that the element itself carries; `pressure` is held.
struct PointBatch {
  int count;
  const Mat3* F;
  double factor;           ///< Of the distortional energy, see PronyHistory.
  double kappa;            ///< [Pa]
  const double* pressure;  ///< Of each point [Pa], or null.
  const Mat3* H;           ///< Of each point [Pa], or null.
};

// The law is looked up once a call, not once a point.

/// theta of each F.
void dilatations(const material::Material& law, int count, const Mat3* F, double* theta);
/// psi without pressure theta, which is counted at the nodes [J/m^3].
void energyDensities(const material::Material& law, const PointBatch& batch, double* psi);
/// The same and P [Pa].
void stresses(const material::Material& law, const PointBatch& batch, double* psi, Mat3* P);
/// d vec P / d vec F [Pa], and d theta/dF where it is asked for.
void tangents(const material::Material& law, const PointBatch& batch, Mat9* C,
              Mat3* theta_gradient);
/// Second Piola-Kirchhoff stress of the distortional energy, factor 1 [Pa]; zero up to kNoStress.
void distortionalStresses(const material::Material& law, int count, const Mat3* F, Mat3* S);

}  // namespace palpate::fem
