// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// Numbers a mesh of linear tetrahedra by its geometry alone: points along a Hilbert curve through
/// the bounding box, each tetrahedron from its least point on (its volume made positive),
/// tetrahedra by their points.
void orderCanonically(TetMesh* mesh);

}  // namespace palpate::mesh
