// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/cell_mesh.h"

namespace palpate::mesh {

/// Edges whose lengths are in [from, to) [m].
struct EdgeClass {
  double from = 0.0, to = 0.0;
  int edges = 0;
};

/// How long the straight lines between the corners of cells are, each counted once [m]. All zero
/// without cells.
struct EdgeLengths {
  double least = 0.0, mean = 0.0, largest = 0.0;
  /// Bounds are 1, 1.5, 2, 3, 5 and 7 of each power of ten, as many classes as are needed.
  std::vector<EdgeClass> classes;
};
EdgeLengths measureEdges(const CellMesh& mesh);

}  // namespace palpate::mesh
