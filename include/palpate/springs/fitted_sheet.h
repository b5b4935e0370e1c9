// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "palpate/mesh/surface_mesh.h"
#include "palpate/springs/constraint_family.h"
#include "palpate/springs/continuum.h"
#include "palpate/springs/sheet_topology.h"
#include "palpate/springs/spring_network.h"

namespace palpate::springs {

/// Springs, and the violation of their conditions.
struct SheetFit {
  SpringNetwork network;
  SheetCounts counts;
  std::vector<ConstraintFamily> preload;    ///< The first is exact.
  std::vector<ConstraintFamily> stiffness;  ///< For given preloads.
};

/// Weights of families of conditions in the least squares, in the order of SheetFit without
/// `balance`; [Wang 2005] gives no values. Residual tension grows against bending with the squared
/// wavelength, so it must be small: with equal weights a plate of 300 points has 50 buckling modes
/// without load. With these weights, 15 plates and discs of 100 to 300 points have none, and 0.71
/// to 0.95 of the exact bending stiffness. This is not guaranteed: check by networkModes().
struct SheetWeights {
  std::array<double, 5> of_preload = {200.0, 200.0, 1.0, 1.0, 10.0};
  std::array<double, 3> of_stiffness = {1.0, 1.0, 1.0};
};

/// Springs of an irregular sheet of triangles, as in sheetTopology() [Wang 2005, 6.3]. The sums are
/// over the springs of a mass with area A, with length U and angle b in its tangent plane:
///
///     preload   balance       sum P e = 0, exactly, in space (6.67, 6.68)
///               no_tension    sum P U = 0 (6.55)
///               no_shear      sum P U {sin 2b, cos 2b} = 0 (6.56, 6.57)
///               bending_2     sum P U^3 {sin 2b, cos 2b} = 0 (6.60, 6.61)
///               bending_4     sum P U^3 {sin 4b, cos 4b} = 0 (6.62, 6.63)
///               bending       sum P U^3 = -16 E A h^3/(3 (1 - nu^2)) (6.66)
///     stiffness stretch_2     sum k U^2 {sin 2b, cos 2b} = 0 (6.75, 6.76)
///               stretch_4     sum (P U - k U^2) {sin 4b, cos 4b} = 0 (6.77, 6.78)
///               stretch       sum k U^2 = 6 E A h (6.81), with 0 <= k <= M (6.82)
///
/// Two least-squares problems, first for P; conditions are relative to the right-hand side of their
/// problem's last one, with the root mean square edge for a missing U. If all hold, cylindrical
/// bending and stretch along a line are exact, with Poisson's ratio 1/3. `match_mean` applies to
/// `bending` and `stretch`.
///
/// @throws std::invalid_argument as sheetTopology(), check() and requirePositive(); `areal_density`
/// in [kg/m^2].
SheetFit fitSheet(const Sheet& sheet, const mesh::SurfaceMesh& surface, double areal_density,
                  const SheetWeights& weights = {}, const FitSettings& settings = {});

}  // namespace palpate::springs
