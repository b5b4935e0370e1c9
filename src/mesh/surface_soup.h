// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// For each point the first one in the very same place (itself, mostly).
std::vector<int> firstInPlace(const Points& points);

/// Whether triangle `t` has a repeated corner or next to no height (kFlatTriangle).
bool isDegenerate(const SurfaceMesh& surface, Eigen::Index t);

/// For each triangle whether an earlier one has the same three corners.
std::vector<bool> findDuplicateTriangles(const Eigen::Matrix3Xi& triangles);

// Each of these changes `surface` and returns how many it mended.
int removeTriangles(SurfaceMesh* surface, const std::vector<bool>& drop);
int mergePoints(SurfaceMesh* surface);                ///< Leaves the doubles as isolated points.
int removeDegenerateTriangles(SurfaceMesh* surface);  ///< See repairSurface().
int removeDuplicateTriangles(SurfaceMesh* surface);
int removeIsolatedPoints(SurfaceMesh* surface);

}  // namespace palpate::mesh
