// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// A part of a mesh as a separate mesh.
struct TetPart {
  TetMesh mesh;
  std::vector<int> nodes;  ///< Its nodes in the whole mesh, ascending.
  std::vector<int> tets;   ///< Its tetrahedra in the whole mesh, ascending.
};

/// The parts of which no two share a node, in the order of their first tetrahedra. Nodes that no
/// tetrahedron uses are in none.
std::vector<TetPart> splitParts(const TetMesh& mesh);

}  // namespace palpate::mesh
