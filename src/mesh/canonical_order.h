// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// Numbers a mesh of linear tetrahedra by geometry alone: points along a Hilbert curve through the
/// bounding box, corners from the least point (with positive volume), tetrahedra by their points.
void orderCanonically(TetMesh* mesh);

}  // namespace palpate::mesh
