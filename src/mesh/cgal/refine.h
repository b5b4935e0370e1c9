// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "palpate/mesh/volume_mesher.h"

namespace palpate::mesh::cgal {

/// The tetrahedra of CGAL's mesher in its own order. `keep_sharp` protects the edges whose normals
/// differ by more than `sharp_degrees`. `expected_tets` serves the progress only.
TetMesh refine(const SurfaceMesh& surface, double edge_length, bool keep_sharp,
               double sharp_degrees, double expected_tets, const MeshingProgress& progress);

}  // namespace palpate::mesh::cgal
