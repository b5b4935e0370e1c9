// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh::cgal {

/// Counts of changes by orientAndClose().
struct ClosingCounts {
  int split_points = 0;    ///< Points doubled where sheets share only a point.
  int stitched_edges = 0;  ///< Border edges joined with their twins.
  int holes = 0;           ///< Filled holes.
  int hole_triangles = 0;  ///< Triangles added to fill holes.
};

/// Orients the triangles consistently, joins coincident borders, and fills holes whose border is no
/// longer than the rim of a disc of `max_hole_share` of the surface's area. @pre Triangles have
/// three different corners; edges have at most two triangles.
SurfaceMesh orientAndClose(const SurfaceMesh& surface, double max_hole_share,
                           ClosingCounts* counts);

/// Triangles that intersect another one, ascending. Empty unless the surface is manifold and
/// consistently oriented.
std::vector<int> selfIntersections(const SurfaceMesh& surface);

/// Orients a closed surface without self-intersections to bound a volume: outward, cavities inward.
SurfaceMesh orientOutward(const SurfaceMesh& surface);

}  // namespace palpate::mesh::cgal
