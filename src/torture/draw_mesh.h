// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/torture/draw.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// Least dihedral angle of a tetrahedron [degrees]; not above 0 if it is inverted.
double leastDihedral(const Points& points, const Eigen::Vector4i& tet);

/// Draws a mesh of about `tets` tetrahedra: `block`, `graded` (edges differ by up to 20 times),
/// `ball` (a rounded block), `sliver` (inner points moved to least angles of 1 to 10 degrees).
void drawMesh(const std::string& shape, int tets, Draw* draw, TortureOrgan* organ);

/// Draws a generated kidney or gallbladder surface, to be meshed.
void drawGeneratedOrgan(Draw* draw, TortureOrgan* organ);

}  // namespace palpate::torture
