// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "palpate/contact/response_settings.h"

namespace palpate::contact {

/// Contact pressure as a function of the penetration p [m] into an obstacle of inscribed radius
/// r [m]; zero for p <= 0:
///
///   k p^2 / (2 e)  up to the smoothing width e, then  k (p - e/2):  the soft part,
///   plus   k p (8 p / r)^3:  the hard part,
///
/// once continuously differentiable. The hard part is 1 % of the soft part at p = r/40. It grows so
/// that tissue does not pass the obstacle's middle, beyond which it would be pushed out on the far
/// side.
struct Penalty {
  double stiffness = ResponseSettings().stiffness;  ///< k [Pa/m]
  double smoothing = ResponseSettings().smoothing;  ///< e [m], > 0

  /// Energy per area [J/m^2], the integral of the pressure.
  double energy(double p, double r) const { return softEnergy(p) + hardEnergy(p, r); }
  /// [Pa]
  double pressure(double p, double r) const { return softPressure(p) + hardPressure(p, r); }
  /// d pressure / d p [Pa/m]
  double slope(double p, double r) const { return softSlope(p) + hardSlope(p, r); }

  // Of both parts.
  double softEnergy(double p) const {
    if (p <= 0.0) return 0.0;
    const double e = smoothing;
    return stiffness * (p < e ? p * p * p / (6.0 * e) : 0.5 * p * (p - e) + e * e / 6.0);
  }
  double softPressure(double p) const {
    if (p <= 0.0) return 0.0;
    return stiffness * (p < smoothing ? p * p / (2.0 * smoothing) : p - 0.5 * smoothing);
  }
  double softSlope(double p) const {
    if (p <= 0.0) return 0.0;
    return stiffness * (p < smoothing ? p / smoothing : 1.0);
  }
  /// Inverse of softPressure(): penetration for `pressure` [Pa], >= 0 [m].
  double softPenetration(double pressure) const {
    const double p = pressure / stiffness;
    return p < 0.5 * smoothing ? std::sqrt(2.0 * smoothing * p) : p + 0.5 * smoothing;
  }
  double hardEnergy(double p, double r) const {
    return p <= 0.0 ? 0.0 : stiffness * p * p / 5.0 * hardening(p, r);
  }
  double hardPressure(double p, double r) const {
    return p <= 0.0 ? 0.0 : stiffness * p * hardening(p, r);
  }
  double hardSlope(double p, double r) const {
    return p <= 0.0 ? 0.0 : 4.0 * stiffness * hardening(p, r);
  }

 private:
  static double hardening(double p, double r) {
    const double q = 8.0 * p / r;
    return q * q * q;
  }
};

}  // namespace palpate::contact
