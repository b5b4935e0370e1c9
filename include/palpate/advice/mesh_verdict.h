// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/sim/simulator.h"

namespace palpate::advice {

/// The edges of a body's surface, where a tool can touch it [m].
struct SurfaceEdges {
  double finest = 0.0;    ///< Mean of a tenth of its points, those with the shortest edges;
  double coarsest = 0.0;  ///< of a tenth, those with the longest;
  double mean = 0.0;      ///< of its triangles, by their area.

  /// Fine and coarse parts, more than irregularity makes them.
  bool graded() const { return coarsest > 3.0 * finest; }
};

/// Of the outside of linear or quadratic tetrahedra (their corners), or of triangles. All zero for
/// other cells and where there are none.
SurfaceEdges surfaceEdges(const mesh::CellMesh& cells);

/// For each organ the tool for which its surface is most too coarse, in a sentence, where that
/// makes the force over 15 % too large: by its mean edges, and where it is graded by the finest
/// ones.
std::vector<std::string> adviseOnMeshes(const sim::Simulator& simulator);

/// What loading decided, and what is to be said of the meshes.
std::vector<std::string> loadingNotes(const sim::Simulator& simulator);

}  // namespace palpate::advice
