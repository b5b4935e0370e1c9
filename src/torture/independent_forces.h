// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/material/material.h"
#include "palpate/mesh/cell_mesh.h"
#include "palpate/sim/simulator.h"

namespace palpate::torture {

// Forces on the points of linear tetrahedra by the textbook's formulas, one tetrahedron after the
// other, to look from outside whether a solver told the truth.

/// Elastic forces -dE/dx, 3 x n [N]; E = sum of V psi(F), F = D_x D_X^-1 [Bonet, Wood 2008, 9.4].
/// Of each tetrahedron its law.
Points elasticForces(const mesh::CellMesh& rest, const Points& now,
                     const std::vector<const material::Material*>& law);

/// Lumped masses: a quarter of each tetrahedron's at each corner, n [kg].
Eigen::VectorXd lumpedMasses(const mesh::CellMesh& rest, double density);

/// What acts at points of the surface, on the corners of the nearest triangle, added to `forces`.
void addAtSurface(const tissue::Shape& shape, const sim::ContactPoint& point, Points* forces);

}  // namespace palpate::torture
