// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/bem/known_bodies.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/mesh/used_points.h"

namespace palpate::test {

/// The boundary of a block of cells from the origin.
inline mesh::SurfaceMesh boxSurface(const Vec3& size, const Eigen::Vector3i& cells) {
  const mesh::TetMesh block = mesh::boxMesh(size, cells);
  return mesh::onlyUsedPoints({block.points, mesh::trianglesOf(mesh::boundaryFaces(block))});
}

/// Both surfaces as one.
inline mesh::SurfaceMesh joined(const mesh::SurfaceMesh& a, const mesh::SurfaceMesh& b) {
  mesh::SurfaceMesh both;
  both.points.resize(3, a.points.cols() + b.points.cols());
  both.points << a.points, b.points;
  both.triangles.resize(3, a.triangles.cols() + b.triangles.cols());
  both.triangles << a.triangles, b.triangles.array() + static_cast<int>(a.points.cols());
  return both;
}

}  // namespace palpate::test
