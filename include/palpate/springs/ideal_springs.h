// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/springs/continuum.h"

namespace palpate::springs {

/// Tangent of a force curve at a spacing.
struct ForceLine {
  double spacing;  ///< [m]
  double force;    ///< Force at the spacing [N]; > 0 pulls.
  double slope;    ///< [N/m]
};

/// Forces of springs to neighbours (structural) and second neighbours (flexion) that give the
/// bending of a beam or plate at every curvature rho [1/m] [Wang 2005, 4.2, 4.3]:
///
///     flexion     W2'(v) = B rho^2 / (cos(U rho) - 1),                  v = (2/rho) sin(U rho)
///     structural  W1'(u) = 2 B rho^2 cos(U rho/2) / (1 - cos(U rho)),   u = (2/rho) sin(U rho/2)
///
/// A beam has B = E I (4.15, 4.16); a sheet of equilateral triangles (1 + nu) D U / sqrt(3)
/// (4.46, 4.47). Curvatures with |U rho| < pi.
class IdealSprings {
 public:
  /// @throws std::invalid_argument, see check() and requirePositive().
  static IdealSprings ofBeam(const BeamSection& beam, double spacing);
  static IdealSprings ofTriangles(const Sheet& sheet, double spacing);

  double structuralSpacing(double rho) const;  ///< u [m]
  double structuralForce(double rho) const;    ///< W1' [N], > 0
  double flexionSpacing(double rho) const;     ///< v [m]
  double flexionForce(double rho) const;       ///< W2' [N], < 0

  /// The line through the limit rho -> 0 and zero force at zero length (4.17, 4.18, 4.25-4.30,
  /// 4.50-4.61). Its rest length is 0 for structural and 6 U for flexion springs.
  ForceLine structuralLimit() const;  ///< At U: 4 B/U^2, slope 4 B/U^3.
  ForceLine flexionLimit() const;     ///< At 2 U: -2 B/U^2, slope B/(2 U^3).

  /// Squared error of the line through the limit with zero force at `rest_length` [m],
  ///
  ///     G1 = integral of (a1 (u - L1) - W1'(u))^2 du                         [N^2 m]
  ///
  /// between the spacings at the curvatures 0 and rho_max (4.19, 4.20).
  double structuralError(double rest_length, double rho_max) const;  ///< 0 <= L1 < U
  double flexionError(double rest_length, double rho_max) const;     ///< L2 > 2 U

  /// Rest length with the least error [m].
  double structuralRestLength(double rho_max) const;  ///< In [0, U).
  double flexionRestLength(double rho_max) const;     ///< Above 2 U.

 private:
  IdealSprings(double bending, double spacing) : B_(bending), U_(spacing) {}

  double B_;  // [N m^2]
  double U_;  // [m]
};

}  // namespace palpate::springs
