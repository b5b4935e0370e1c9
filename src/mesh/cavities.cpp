// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/cavities.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "surface_edges.h"

namespace palpate::mesh {

std::vector<std::vector<int>> cavityNodes(const TetMesh& mesh) {
  const Eigen::MatrixXi faces = boundaryFaces(mesh);
  UnionFind pieces(mesh.numPoints());
  for (Eigen::Index t = 0; t < faces.cols(); ++t) {
    for (Eigen::Index a = 1; a < faces.rows(); ++a) pieces.join(faces(0, t), faces(a, t));
  }
  // Volume by the divergence theorem; faces point out of the tetrahedra, into a cavity.
  const Vec3 origin = mesh.points.rowwise().mean();
  const Eigen::Matrix3Xi triangles = trianglesOf(faces);
  std::map<int, double> enclosed;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const Vec3 a = mesh.points.col(triangles(0, t)) - origin;
    const Vec3 b = mesh.points.col(triangles(1, t)) - origin;
    const Vec3 c = mesh.points.col(triangles(2, t)) - origin;
    enclosed[pieces.find(triangles(0, t))] -= a.cross(b).dot(c) / 6.0;
  }
  std::vector<std::pair<double, int>> cavities;
  for (const auto& [piece, volume] : enclosed) {
    if (volume > 0.0) cavities.emplace_back(-volume, piece);
  }
  std::sort(cavities.begin(), cavities.end());
  std::vector<std::vector<int>> nodes;
  for (const auto& [volume, piece] : cavities) {
    nodes.emplace_back();
    for (int i = 0; i < static_cast<int>(mesh.numPoints()); ++i) {
      if (pieces.find(i) == piece) nodes.back().push_back(i);
    }
  }
  return nodes;
}

}  // namespace palpate::mesh
