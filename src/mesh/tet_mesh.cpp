// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/tet_mesh.h"

#include <algorithm>
#include <array>
#include <map>

namespace palpate::mesh {
namespace {

// Faces of a tetrahedron of positive volume, seen counter-clockwise from outside.
constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// Kuhn's six tetrahedra of a cell: all monotone paths from corner 000 to corner 111. Bit i of a
// corner's number is its step along axis i.
constexpr int kKuhn[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                             {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

}  // namespace

double signedVolume(const Points& points, const Eigen::Vector4i& t) {
  const Vec3 a = points.col(t[0]);
  return (points.col(t[1]) - a).cross(points.col(t[2]) - a).dot(points.col(t[3]) - a) / 6.0;
}

Eigen::Matrix3Xi boundaryTriangles(const Eigen::Matrix4Xi& tets) {
  std::map<std::array<int, 3>, int> count;
  const auto key = [&](Eigen::Index e, int f) {
    std::array<int, 3> k{tets(kFaces[f][0], e), tets(kFaces[f][1], e), tets(kFaces[f][2], e)};
    std::sort(k.begin(), k.end());
    return k;
  };
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    for (int f = 0; f < 4; ++f) ++count[key(e, f)];
  }
  std::vector<Eigen::Vector3i> boundary;
  for (Eigen::Index e = 0; e < tets.cols(); ++e) {
    for (int f = 0; f < 4; ++f) {
      if (count[key(e, f)] != 1) continue;
      boundary.emplace_back(tets(kFaces[f][0], e), tets(kFaces[f][1], e), tets(kFaces[f][2], e));
    }
  }
  Eigen::Matrix3Xi triangles(3, boundary.size());
  for (std::size_t i = 0; i < boundary.size(); ++i) triangles.col(i) = boundary[i];
  return triangles;
}

TetMesh boxMesh(const Vec3& size, const Eigen::Vector3i& cells) {
  TetMesh mesh;
  const Eigen::Vector3i n = cells.array() + 1;
  mesh.points.resize(3, n.prod());
  const auto node = [&](int i, int j, int k) { return i + n.x() * (j + n.y() * k); };
  for (int k = 0; k < n.z(); ++k) {
    for (int j = 0; j < n.y(); ++j) {
      for (int i = 0; i < n.x(); ++i) {
        mesh.points.col(node(i, j, k)) =
            size.cwiseProduct(Vec3(i, j, k).cwiseQuotient(cells.cast<double>()));
      }
    }
  }
  mesh.tets.resize(4, 6 * cells.prod());
  Eigen::Index e = 0;
  for (int k = 0; k < cells.z(); ++k) {
    for (int j = 0; j < cells.y(); ++j) {
      for (int i = 0; i < cells.x(); ++i) {
        for (const auto& path : kKuhn) {
          for (int c = 0; c < 4; ++c) {
            const int corner = path[c];
            mesh.tets(c, e) = node(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
          }
          ++e;
        }
      }
    }
  }
  return mesh;
}

}  // namespace palpate::mesh
