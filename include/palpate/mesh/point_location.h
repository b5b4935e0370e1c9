// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// A point in a tetrahedron of a mesh.
struct Location {
  int tet = -1;
  Eigen::Vector4d w;  ///< Barycentric coordinates, sum 1; of a curved tetrahedron those of its
                      ///< straight original.
};

/// Locates the point `p` [m]; none where outside of all tetrahedra by more than 1e-6. Newton's
/// method in curved tetrahedra.
std::optional<Location> locate(const TetMesh& mesh, const Vec3& p);

/// Nodes of the tetrahedron with shape functions at the point.
std::vector<std::pair<int, double>> shapeValues(const TetMesh& mesh, const Location& at);

/// Values at the nodes, one column each, interpolated by the shape functions.
Vec3 interpolate(const TetMesh& mesh, const Location& at, const Points& values);

}  // namespace palpate::mesh
