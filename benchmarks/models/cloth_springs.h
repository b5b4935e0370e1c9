// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "palpate/springs/spring_grids.h"

namespace palpate::models {

/// side x side masses `spacing` apart with the springs of the demonstration that [Wang 2005, 4.4]
/// begins with: squares, structural and flexion 4.0, shear 2.4, no preload.
inline springs::SpringNetwork olderSheet(double spacing, int side, double areal_density) {
  return springs::rectangleNetwork({{0.0, 4.0}, {0.0, 4.0}, {0.0, 2.4}}, spacing,
                                   springs::rectangleNodes(side, side), areal_density);
}

/// The springs that replace them: triangles, structural 4.0 that are without force at no length,
/// flexion 0.5 that are at six spacings (4.59, 4.61).
inline springs::SpringNetwork newerSheet(double spacing, int side, double areal_density) {
  return springs::triangleNetwork({{4.0 * spacing, 4.0}, {-2.0 * spacing, 0.5}}, spacing,
                                  springs::triangleNodes(side, side), areal_density);
}

/// D (1 + nu) of the newer ones (4.59).
inline double newerBending(double spacing) { return std::sqrt(3.0) * spacing * spacing; }

}  // namespace palpate::models
