// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/torture/draw.h"
#include "palpate/torture/torture_scene.h"

namespace palpate::torture {

/// Least angle between two faces of a tetrahedron [degrees]; not above 0 where it is inverted.
double leastDihedral(const Points& points, const Eigen::Vector4i& tet);

/// Gives an organ of some size its mesh of about `tets` tetrahedra: `block`, `graded` (edges that
/// differ by up to 20 times), `ball` (a block with its edges rounded off), `sliver` (inner points
/// moved until the least angle is 1 to 10 degrees).
void drawMesh(const std::string& shape, int tets, Draw* draw, TortureOrgan* organ);

/// A kidney or a gallbladder of the generator, to be filled.
void drawGeneratedOrgan(Draw* draw, TortureOrgan* organ);

}  // namespace palpate::torture
