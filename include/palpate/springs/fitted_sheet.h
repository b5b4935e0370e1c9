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

/// Springs and what they lack of their conditions.
struct SheetFit {
  SpringNetwork network;
  SheetCounts counts;
  std::vector<ConstraintFamily> preload;    ///< The first is kept exactly.
  std::vector<ConstraintFamily> stiffness;  ///< Given the preloads.
};

/// Weights of the families of conditions in the least squares, in the order of SheetFit without
/// `balance`; [Wang 2005] has them without values. Tension that is left over counts beside bending
/// as the square of a wave's length, so it must be small: with equal weights a plate of 300 points
/// has 50 modes in which it buckles by itself. With these none of 15 plates and discs of 100 to 300
/// points does, and they bend with 0.71 to 0.95 of their stiffness. There is no guarantee:
/// networkModes() tells.
struct SheetWeights {
  std::array<double, 5> of_preload = {200.0, 200.0, 1.0, 1.0, 10.0};
  std::array<double, 3> of_stiffness = {1.0, 1.0, 1.0};
};

/// Springs of an irregular sheet of triangles, where sheetTopology() has them [Wang 2005, 6.3].
/// Over the springs of a mass with the area A, U long and at the angles b in the tangent plane
/// there:
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
/// Two least squares, the first for P, each condition over the size of the last one's right side, U
/// taken as the root of the mean square of the edges where it is missing. Met by all, bending to a
/// cylinder and stretch along a line are exact, Poisson's ratio is 1/3. `match_mean` is about
/// `bending` and `stretch`.
///
/// @throws std::invalid_argument as sheetTopology(), check() and requirePositive(); `areal_density`
/// [kg/m^2].
SheetFit fitSheet(const Sheet& sheet, const mesh::SurfaceMesh& surface, double areal_density,
                  const SheetWeights& weights = {}, const FitSettings& settings = {});

}  // namespace palpate::springs
