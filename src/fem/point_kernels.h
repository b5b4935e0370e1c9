// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/material/material.h"

namespace palpate::fem {

/// Integration points of one solid, with the element's and the viscous terms of the energy:
///
///   psi = factor psi_dist(F) + kappa/2 theta^2 + pressure theta + 1/2 H : (F^T F - I)
///
/// kappa is the elements' own part of the bulk modulus; `pressure` is held constant.
struct PointBatch {
  int count;
  const Mat3* F;
  double factor;           ///< Factor of the distortional energy, see PronyHistory.
  double kappa;            ///< [Pa]
  const double* pressure;  ///< Of each point [Pa]; may be null.
  const Mat3* H;           ///< Of each point [Pa]; may be null.
};

// The law is dispatched once per call, not per point.

/// Computes theta for each F.
void dilatations(const material::Material& law, int count, const Mat3* F, double* theta);
/// psi without pressure theta, which the nodes count [J/m^3].
void energyDensities(const material::Material& law, const PointBatch& batch, double* psi);
/// psi and P [Pa].
void stresses(const material::Material& law, const PointBatch& batch, double* psi, Mat3* P);
/// d vec P / d vec F [Pa], and d theta/dF if not null.
void tangents(const material::Material& law, const PointBatch& batch, Mat9* C,
              Mat3* theta_gradient);
/// Second Piola-Kirchhoff stress of psi_dist, factor 1 [Pa]; zero for det F <= kNoStress.
void distortionalStresses(const material::Material& law, int count, const Mat3* F, Mat3* S);

}  // namespace palpate::fem
