// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// Nodes of the surface of each cavity that tetrahedra leave, ascending: of each piece of the
/// boundary, by common nodes, that encloses space and no tetrahedra. The largest cavity comes
/// first.
std::vector<std::vector<int>> cavityNodes(const TetMesh& mesh);

}  // namespace palpate::mesh
