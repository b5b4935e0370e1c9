// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// A closed surface of about the same shape with `num_triangles` triangles, by collapsing edges
/// [Lindstrom, Turk 1998]. Deterministic.
/// @throws std::invalid_argument for a number that is not even and at least 4, or that cannot be
/// reached; and for a surface that is not a closed manifold.
SurfaceMesh simplify(const SurfaceMesh& surface, int num_triangles);

/// Each triangle in four, at the middles of its edges. The first points are those of `surface`, in
/// their order.
SurfaceMesh splitTriangles(const SurfaceMesh& surface);

/// Moves `points` from the index `first` on to where the surface is nearest.
void moveOnto(const SurfaceMesh& surface, Eigen::Index first, Points* points);

}  // namespace palpate::mesh
