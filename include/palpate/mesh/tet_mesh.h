// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::mesh {

/// Tetrahedra that fill a body.
struct TetMesh {
  Points points;          ///< 3 x n [m].
  Eigen::Matrix4Xi tets;  ///< Corner indices, 4 x m; positive volume: (b-a) x (c-a) . (d-a) > 0.
  /// Mid-edge nodes of quadratic tetrahedra, 6 x m in VTK order (edges 01 12 20 03 13 23);
  /// 0 columns in a mesh of linear ones.
  Eigen::Matrix<int, 6, Eigen::Dynamic> midnodes;
  std::vector<int> region;  ///< One tag a tetrahedron, or empty: all in region 0.
  /// What the file says besides of each tetrahedron, by name: 1 x m or 3 x m; NaN where it says
  /// nothing.
  std::map<std::string, Eigen::MatrixXd> cell_data;

  Eigen::Index numPoints() const { return points.cols(); }
  Eigen::Index numTets() const { return tets.cols(); }
  bool quadratic() const { return midnodes.cols() > 0; }
};

/// Signed volume of tetrahedron `t` of corners in `points` [m^3].
double signedVolume(const Points& points, const Eigen::Vector4i& t);

/// Of each tetrahedron: bit k says that its face opposite corner k is on the boundary.
std::vector<std::uint8_t> outerSides(const Eigen::Matrix4Xi& tets);

/// Outward boundary triangles of the corner tetrahedra, 3 x k, in the order of the tetrahedra.
Eigen::Matrix3Xi boundaryTriangles(const Eigen::Matrix4Xi& tets);

/// Outward boundary faces: as boundaryTriangles(), and in a mesh of quadratic tetrahedra 6 x k, the
/// corners and then the middles of the edges 01 12 20.
Eigen::MatrixXi boundaryFaces(const TetMesh& mesh);

/// Triangles through all nodes of `faces` (3 x k or 6 x k): four for each quadratic face.
Eigen::Matrix3Xi trianglesOf(const Eigen::MatrixXi& faces);

/// 10-node tetrahedra with nodes in the middle of straight edges; the points of `mesh` stay the
/// first ones. A mesh that is quadratic is returned as it is.
TetMesh toQuadratic(const TetMesh& mesh);

/// The first tetrahedron with a middle node that is farther than 1e-9 of its edge's length from the
/// middle of it, or -1.
Eigen::Index firstBentTet(const TetMesh& mesh);

/// A box [0, size] cut into cells, five or six tetrahedra each; `cells` per axis, six each here
/// (Kuhn's subdivision, conforming).
TetMesh boxMesh(const Vec3& size, const Eigen::Vector3i& cells);

}  // namespace palpate::mesh
