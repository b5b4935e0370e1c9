// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// A point of a triangle: barycentric `weights` in [0, 1], sum 1, of its `nodes`.
struct SurfacePoint {
  Eigen::Vector3i nodes;
  Vec3 weights;
};

/// Nearest surface point of each of `points`, 3 x n [m].
std::vector<SurfacePoint> nearestSurfacePoints(const SurfaceMesh& surface, const Points& points);

/// Interpolates nodal values, 3 x m, to surface points, 3 x n.
void interpolate(const std::vector<SurfacePoint>& places, const Points& values, Points* there);

}  // namespace palpate::mesh
