// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh::cgal {

/// What orientAndClose() did.
struct ClosingCounts {
  int split_points = 0;    ///< Points doubled where sheets touch in a point only.
  int stitched_edges = 0;  ///< Border edges joined with their twin.
  int holes = 0;           ///< Filled.
  int hole_triangles = 0;  ///< Added for it.
};

/// Orients the triangles alike, joins coincident borders and fills the holes whose rim has at most
/// the length of the rim of a disc of `max_hole_share` of the surface's area. Every triangle has
/// three different corners; no edge has more than two triangles.
SurfaceMesh orientAndClose(const SurfaceMesh& surface, double max_hole_share,
                           ClosingCounts* counts);

/// Triangles that cut another one, ascending. The surface is manifold and consistently oriented,
/// otherwise the result is empty.
std::vector<int> selfIntersections(const SurfaceMesh& surface);

/// Orients a closed surface without self-intersections so that it bounds a volume: outward, and
/// cavities inward.
SurfaceMesh orientOutward(const SurfaceMesh& surface);

}  // namespace palpate::mesh::cgal
