// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "palpate/mesh/cell_mesh.h"

namespace palpate::mesh {

/// All points with low <= p <= high [m]; without end where a bound is infinite, so that one bound
/// alone is a half space.
struct CutBox {
  Vec3 low = Vec3::Constant(-std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(std::numeric_limits<double>::infinity());
};

/// The surface of what is left of a body when a box has been taken out of it. Vertices are fixed in
/// the material: they go with the points of the mesh, and as each stays in its tetrahedron or on
/// its outer triangle, a surface that is closed stays closed however the body deforms.
struct Cutaway {
  /// Of each vertex, 4 x 3 m, three columns a triangle, outward: points of the mesh, and the part
  /// that each has of it (sum 1).
  Eigen::Matrix4Xi corners;
  Eigen::Matrix4Xd weights;
  std::vector<int> solid;      ///< Of each triangle, that of its cell.
  Eigen::Index num_outer = 0;  ///< Triangles of the body's own surface; after them those of cuts.
  std::vector<int> bared;      ///< Points of the mesh in the box or on its faces.

  Eigen::Index numTriangles() const { return corners.cols() / 3; }
  /// The vertices, 3 x 3 m [m], where the points of the mesh are at `x`, 3 x n [m].
  void interpolate(const Points& x, Points* vertices) const;
};

/// Takes the box out of the body, at rest. Tetrahedra and hexahedra (each as six tetrahedra) have
/// faces where they are cut, quadratic tetrahedra are eight linear ones; of triangles what is
/// outside of the box is left, and of lines nothing. Points that are nearer to a face of the box
/// than 1e-9 of the body's size are on it.
/// @throws std::invalid_argument if the box has no room inside, or a bound is NaN.
Cutaway cutAway(const CellMesh& body, const CutBox& box);

}  // namespace palpate::mesh
