// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "palpate/mesh/cell_mesh.h"

namespace palpate::mesh {

/// Points with low <= p <= high [m]; bounds may be infinite, and a single one is a half space.
struct CutBox {
  Vec3 low = Vec3::Constant(-std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(std::numeric_limits<double>::infinity());
};

/// Surface of a body without a box. Vertices are material points in tetrahedra or on outer
/// triangles, so a closed surface stays closed under deformation.
struct Cutaway {
  /// Mesh points and weights (sum 1) of each vertex, 4 x 3 m; three columns per triangle, outward.
  Eigen::Matrix4Xi corners;
  Eigen::Matrix4Xd weights;
  std::vector<int> solid;      ///< Solid of each triangle.
  Eigen::Index num_outer = 0;  ///< Number of triangles of the body's surface; cut faces follow.
  std::vector<int> bared;      ///< Mesh points in the box or on its faces.

  Eigen::Index numTriangles() const { return corners.cols() / 3; }
  /// Computes the vertices, 3 x 3 m [m], for mesh points `x`, 3 x n [m].
  void interpolate(const Points& x, Points* vertices) const;
};

/// Removes the box from the body at rest. Tetrahedra and hexahedra (six tetrahedra each) get faces
/// at cuts; quadratic tetrahedra are eight linear ones; triangles are clipped, lines removed.
/// Points within 1e-9 of the body's size are on the box.
/// @throws std::invalid_argument for an empty box or a NaN bound.
Cutaway cutAway(const CellMesh& body, const CutBox& box);

}  // namespace palpate::mesh
