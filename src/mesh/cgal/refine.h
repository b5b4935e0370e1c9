// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "palpate/mesh/size_field.h"
#include "palpate/mesh/volume_mesher.h"

namespace palpate::mesh::cgal {

/// The tetrahedra of CGAL's mesher in its own order, with mean edges of the length that `sizes` has
/// where they are. `keep_sharp` protects the edges whose normals differ by more than
/// `sharp_degrees`. `expected_tets` serves the progress only.
TetMesh refine(const SurfaceMesh& surface, const BodySizes& sizes, bool keep_sharp,
               double sharp_degrees, double expected_tets, const MeshingProgress& progress);

}  // namespace palpate::mesh::cgal
