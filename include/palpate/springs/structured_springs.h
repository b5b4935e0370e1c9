// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/springs/continuum.h"

namespace palpate::springs {

/// Values of one kind of springs in a regular mesh.
struct StencilSpring {
  double preload;    ///< [N]
  double stiffness;  ///< [N/m]
};

/// A straight line of masses with springs to neighbours and second neighbours.
struct LineSprings {
  StencilSpring structural, flexion;
};

/// A mesh of squares: structural springs along sides, flexion springs over two sides, shear springs
/// along diagonals.
struct RectangleSprings {
  StencilSpring structural, flexion, shear;
};

/// A mesh of equilateral triangles: structural springs along sides, flexion springs over two sides.
struct TriangleSprings {
  StencilSpring structural, flexion;
};

/// A lattice of cubes without preload; stiffnesses of inner springs [N/m].
struct CubeSprings {
  double edge, face_diagonal, body_diagonal;
};

/// Linear springs with preload for masses `spacing` U apart [Wang 2005, chapter 5]:
///
///     P1 = 4 E I/U^2,  P2 = -2 E I/U^2 (5.19, 5.20),   k1 + 4 k2 = E A/U (5.26)
///
/// With k2 = 0 (5.29) free ends contract in their last spring only.
///
/// @throws std::invalid_argument for a constant out of range, or a negative k1.
LineSprings lineSprings(const BeamSection& beam, double spacing, double flexion_stiffness = 0.0);

/// The same preloads, and stiffnesses with zero force at zero length (5.21, 5.22): right in
/// bending, far too soft in stretch.
LineSprings bendingLineSprings(const BeamSection& beam, double spacing);

/// P1 = E h^3/(2 (1 - nu) U), P2 = -P1/4, P3 = -sqrt(2) P1/4 (5.69-5.71),
/// k1 + 4 k2 = E h (2 U^2 + h^2)/(4 (1 - nu) U^2) (5.102), k3 = E h (2 U^2 - h^2)/(8 (1 - nu) U^2)
/// (5.101), k2 = 0. The print has 8 for the 4 in (5.102) and (5.151), which contradicts (5.86) and
/// (5.100) and makes the sheet stretch differently in each direction.
///
/// @throws std::invalid_argument also if h^2 > 2 U^2: k3 would be negative.
RectangleSprings rectangleSprings(const Sheet& sheet, double spacing,
                                  Constants constants = Constants::kCorrected);

/// P1 = sqrt(3) E h^3/(9 (1 - nu) U), P2 = -P1/2 (5.114, 5.115), k1 = sqrt(3) E h/(3 (1 - nu))
/// (5.152), k2 = 0.
TriangleSprings triangleSprings(const Sheet& sheet, double spacing);

/// The springs of chapter 4 (4.50-4.61, 5.116, 5.117): right in bending, far too soft in stretch.
TriangleSprings bendingTriangleSprings(const Sheet& sheet, double spacing);

/// Diagonals of a lattice of cubes in addition to its edges.
enum class CubeDiagonals {
  kFaces,  ///< k1 = k2 = 2 E h/5 (7.71)
  kBody    ///< k1 = 4 E h/5, k3 = 3 E h/10 (7.72, 7.73): has three mechanisms.
};

/// Cubes of edge `edge` h of a solid with Poisson's ratio 1/4: 3 k1 - 3 k2 - 8 k3 = 0 (7.69) and
/// k1 + 4 k2 + 4 k3 = 2 E h. The print has 4 E h in (7.70), twice what (7.59) demands.
CubeSprings cubeSprings(double young_modulus, double edge, CubeDiagonals diagonals,
                        Constants constants = Constants::kCorrected);

}  // namespace palpate::springs
