// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// For each point the first point at the same position, mostly itself.
std::vector<int> firstInPlace(const Points& points);

/// Whether triangle `t` has a repeated corner or a height below kCollapsedTriangle.
bool isDegenerate(const SurfaceMesh& surface, Eigen::Index t);

/// Whether an earlier triangle has the same three corners, for each triangle.
std::vector<bool> findDuplicateTriangles(const Eigen::Matrix3Xi& triangles);

// Each function changes `surface` and returns the number of repairs.
int removeTriangles(SurfaceMesh* surface, const std::vector<bool>& drop);
int mergePoints(SurfaceMesh* surface);                ///< Leaves duplicates as isolated points.
int removeDegenerateTriangles(SurfaceMesh* surface);  ///< See repairSurface().
int removeDuplicateTriangles(SurfaceMesh* surface);
int removeIsolatedPoints(SurfaceMesh* surface);

}  // namespace palpate::mesh
