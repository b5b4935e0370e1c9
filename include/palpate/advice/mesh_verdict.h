// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/sim/simulator.h"

namespace palpate::advice {

/// Edge lengths of a body's surface [m].
struct SurfaceEdges {
  double finest = 0.0;    ///< Mean over the 10 % of points with the shortest edges.
  double coarsest = 0.0;  ///< Mean over the 10 % of points with the longest edges.
  double mean = 0.0;      ///< Mean over the triangles, weighted by area.

  /// Whether refinement, not irregularity, explains the range of edges.
  bool graded() const { return coarsest > 3.0 * finest; }
};

/// For the surface of linear or quadratic tetrahedra (their corners), or of triangles. Zeros for
/// other cells, or none.
SurfaceEdges surfaceEdges(const mesh::CellMesh& cells);

/// A sentence for each organ about the tool for which its surface is coarsest, if that makes the
/// force more than 15 % too large. Judged by mean edges, of graded surfaces by the finest ones.
std::vector<std::string> adviseOnMeshes(const sim::Simulator& simulator);

/// Decisions of loading, and advice on meshes.
std::vector<std::string> loadingNotes(const sim::Simulator& simulator);

}  // namespace palpate::advice
