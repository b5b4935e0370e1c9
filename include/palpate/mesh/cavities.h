// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// Surface nodes of each cavity, ascending: of each connected component of the boundary that
/// encloses no tetrahedra. The largest cavity comes first.
std::vector<std::vector<int>> cavityNodes(const TetMesh& mesh);

}  // namespace palpate::mesh
