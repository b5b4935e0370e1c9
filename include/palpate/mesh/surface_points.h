// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// A place in a triangle: the sum of `weights`, which are in [0, 1] and sum to 1, times `nodes`.
struct SurfacePoint {
  Eigen::Vector3i nodes;
  Vec3 weights;
};

/// Where the triangles are nearest to `points` (3 x n), one place each.
std::vector<SurfacePoint> nearestSurfacePoints(const SurfaceMesh& surface, const Points& points);

/// Values at the nodes (3 x m) interpolated there: 3 x n.
void interpolate(const std::vector<SurfacePoint>& places, const Points& values, Points* there);

}  // namespace palpate::mesh
