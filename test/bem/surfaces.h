// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/mesh/used_points.h"

namespace palpate::test {

/// A sphere about the origin, of an icosahedron whose edges are halved `level` times: 10 * 4^level
/// + 2 points on it.
inline mesh::SurfaceMesh sphere(int level, double radius, bool outward = true) {
  const double t = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vec3> points = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                              {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                              {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
  std::vector<Eigen::Vector3i> faces = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (; level > 0; --level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (is_new) {
        points.push_back(points[static_cast<std::size_t>(a)].normalized() +
                         points[static_cast<std::size_t>(b)].normalized());
      }
      return at->second;
    };
    std::vector<Eigen::Vector3i> finer;
    for (const Eigen::Vector3i& f : faces) {
      const int a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    faces = finer;
  }
  mesh::SurfaceMesh made;
  made.points.resize(3, static_cast<Eigen::Index>(points.size()));
  made.triangles.resize(3, static_cast<Eigen::Index>(faces.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    made.points.col(static_cast<Eigen::Index>(i)) = radius * points[i].normalized();
  }
  for (std::size_t k = 0; k < faces.size(); ++k) {
    made.triangles.col(static_cast<Eigen::Index>(k)) =
        outward ? faces[k] : Eigen::Vector3i(faces[k][0], faces[k][2], faces[k][1]);
  }
  return made;
}

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
