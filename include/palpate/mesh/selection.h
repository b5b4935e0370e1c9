// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// All points with |p[axis] - at| <= tolerance.
struct PlaneRegion {
  int axis = 2;             ///< 0 x, 1 y, 2 z.
  double at = 0.0;          ///< [m]
  double tolerance = -1.0;  ///< [m]; negative: 1e-9 of the bounding box's diagonal.
};
/// All points with min <= p <= max, component by component.
struct BoxRegion {
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();  ///< [m]
};
/// All points within `radius` of `center`.
struct SphereRegion {
  Vec3 center = Vec3::Zero();  ///< [m]
  double radius = 0.0;         ///< [m]
};
using Region = std::variant<PlaneRegion, BoxRegion, SphereRegion>;

/// Indices of the points in the region, ascending.
std::vector<int> selectPoints(const Points& points, const Region& region);

/// All points p with normal . (p - point) >= 0.
struct HalfSpaceRegion {
  Vec3 point = Vec3::Zero();    ///< [m]
  Vec3 normal = Vec3::UnitZ();  ///< Into the half space, of any length but zero.
};
/// Tetrahedra that the mesh file gives a whole number `value`.
struct CellDataRegion {
  std::string name;  ///< Of TetMesh::cell_data; empty: TetMesh::region.
  int value = 0;
};
/// Tetrahedra by the distance of their centroid from the surface of the body: a capsule, a core.
struct DepthRegion {
  double min = 0.0;                                      ///< [m]
  double max = std::numeric_limits<double>::infinity();  ///< [m]
};
/// Tetrahedra by their centroid, by what the file says of them, or by depth.
using TetRegion =
    std::variant<BoxRegion, SphereRegion, HalfSpaceRegion, CellDataRegion, DepthRegion>;

/// Indices of the tetrahedra in the region, ascending.
/// @throws std::invalid_argument if cell data is asked for that the mesh does not have (naming what
/// it has), or that is not whole numbers.
std::vector<int> selectTets(const TetMesh& mesh, const TetRegion& region);

/// Centroids of the corners, 3 x m [m].
Points tetCentroids(const TetMesh& mesh);

/// Distance of each of the `points` from the body's boundary triangles [m], >= 0 on both sides.
Eigen::VectorXd surfaceDistances(const TetMesh& mesh, const Points& points);

}  // namespace palpate::mesh
