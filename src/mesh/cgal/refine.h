// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "palpate/mesh/size_field.h"
#include "palpate/mesh/volume_mesher.h"

namespace palpate::mesh::cgal {

/// Tetrahedra of CGAL's mesher in its order, with local mean edges as in `sizes`. `keep_sharp`
/// preserves edges whose normals differ by more than `sharp_degrees`. `expected_tets` is for the
/// progress only.
TetMesh refine(const SurfaceMesh& surface, const BodySizes& sizes, bool keep_sharp,
               double sharp_degrees, double expected_tets, const MeshingProgress& progress);

}  // namespace palpate::mesh::cgal
