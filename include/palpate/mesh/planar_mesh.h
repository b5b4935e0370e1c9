// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// Corners of a closed polygon, 2 x n [m], without the first one again.
using Polygon = Eigen::Matrix2Xd;

/// Triangles of about `edge_length` [m] that fill the first polygon without the holes, in the plane
/// z = 0, counter-clockwise seen from +z: Delaunay refinement without angles below 20 degrees
/// where the polygons have none (CGAL Mesh_2). Corners stay; sides are cut into equal parts, and
/// further where they must be. Deterministic: the same input gives the same bits, which CGAL's
/// smoothing would not.
///
/// @throws std::invalid_argument for a polygon of fewer than 3 corners or one that is not finite,
/// an edge length that is not > 0, over kMaxPlanarTriangles expected, or sides that cross or
/// touch.
SurfaceMesh meshPolygon(const Polygon& outline, const std::vector<Polygon>& holes,
                        double edge_length);

constexpr double kMaxPlanarTriangles = 1.0e6;

/// A polygon whose corners are on a circle, with sides of about `edge_length` [m].
Polygon circle(const Eigen::Vector2d& centre, double radius, double edge_length);

}  // namespace palpate::mesh
