// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::contact {

/// Pressure against penetration p [m], once continuously differentiable: k p^2 / (2 e) up to the
/// smoothing width e, then k (p - e/2); zero for p <= 0.
struct Penalty {
  double stiffness;  ///< k [Pa/m]
  double smoothing;  ///< e [m], > 0

  /// Energy per area [J/m^2], the integral of the pressure.
  double energy(double p) const {
    if (p <= 0.0) return 0.0;
    const double e = smoothing;
    return p < e ? stiffness * p * p * p / (6.0 * e)
                 : stiffness * (0.5 * p * (p - e) + e * e / 6.0);
  }
  /// [Pa]
  double pressure(double p) const {
    if (p <= 0.0) return 0.0;
    return p < smoothing ? stiffness * p * p / (2.0 * smoothing)
                         : stiffness * (p - 0.5 * smoothing);
  }
  /// d pressure / d p [Pa/m]
  double slope(double p) const {
    if (p <= 0.0) return 0.0;
    return p < smoothing ? stiffness * p / smoothing : stiffness;
  }
};

}  // namespace palpate::contact
