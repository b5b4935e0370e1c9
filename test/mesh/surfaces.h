// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// A box [0, size] with its corner at the origin and `cells` squares a side.
inline SurfaceMesh boxSurface(double size, int cells) {
  const TetMesh box = boxMesh(Vec3::Constant(size), Eigen::Vector3i::Constant(cells));
  SurfaceMesh surface;
  surface.points = box.points;
  surface.triangles = boundaryTriangles(box.tets);
  // The points inside are of no triangle: only those on the boundary are taken.
  std::vector<int> renamed(box.numPoints(), -1);
  int kept = 0;
  for (Eigen::Index c = 0; c < surface.triangles.size(); ++c) {
    int& corner = surface.triangles(c % 3, c / 3);
    if (renamed[corner] < 0) {
      renamed[corner] = kept++;
      surface.points.col(renamed[corner]) = box.points.col(corner);
    }
    corner = renamed[corner];
  }
  surface.points.conservativeResize(3, kept);
  return surface;
}

inline SurfaceMesh joined(const SurfaceMesh& a, const SurfaceMesh& b) {
  SurfaceMesh both;
  both.points.resize(3, a.points.cols() + b.points.cols());
  both.points << a.points, b.points;
  both.triangles.resize(3, a.triangles.cols() + b.triangles.cols());
  both.triangles << a.triangles, (b.triangles.array() + static_cast<int>(a.points.cols())).matrix();
  return both;
}

inline SurfaceMesh moved(SurfaceMesh surface, const Vec3& by) {
  surface.points.colwise() += by;
  return surface;
}

inline void flip(SurfaceMesh* surface, Eigen::Index t) {
  std::swap(surface->triangles(1, t), surface->triangles(2, t));
}

inline void flipAll(SurfaceMesh* surface) {
  for (Eigen::Index t = 0; t < surface->triangles.cols(); ++t) flip(surface, t);
}

inline void removeLastTriangles(SurfaceMesh* surface, Eigen::Index count) {
  surface->triangles.conservativeResize(3, surface->triangles.cols() - count);
}

}  // namespace palpate::mesh
