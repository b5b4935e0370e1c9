// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "palpate/mesh/selection.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::test {

/// `mesh` without the tetrahedra whose middle is `inside`, and without points that none uses.
inline mesh::TetMesh without(const mesh::TetMesh& mesh,
                             const std::function<bool(const Vec3&)>& inside) {
  const Points middles = mesh::tetCentroids(mesh);
  mesh::TetMesh hollow;
  hollow.tets.resize(4, mesh.numTets());
  std::vector<int> number(static_cast<std::size_t>(mesh.numPoints()), -1), kept;
  Eigen::Index count = 0;
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    if (inside(middles.col(t))) continue;
    for (int k = 0; k < 4; ++k) {
      int& i = number[static_cast<std::size_t>(mesh.tets(k, t))];
      if (i < 0) {
        i = static_cast<int>(kept.size());
        kept.push_back(mesh.tets(k, t));
      }
      hollow.tets(k, count) = i;
    }
    ++count;
  }
  hollow.tets.conservativeResize(4, count);
  hollow.points = mesh.points(Eigen::all, kept);
  return hollow;
}

/// A cube of 60 mm in cells of 10 mm, with a cavity of 20 mm in its middle.
inline mesh::TetMesh hollowCube() {
  return without(mesh::boxMesh(Vec3::Constant(0.06), Eigen::Vector3i::Constant(6)),
                 [](const Vec3& p) { return (p.array() > 0.02 && p.array() < 0.04).all(); });
}

/// A ball of radius 2 about the origin with a cavity of radius 1, of `cells` of a cube around it, a
/// multiple of four: a shell of cells / 4 layers.
inline mesh::TetMesh hollowBall(int cells) {
  mesh::TetMesh cube = mesh::boxMesh(Vec3::Constant(4.0), Eigen::Vector3i::Constant(cells));
  cube.points.array() -= 2.0;
  mesh::TetMesh ball = without(cube, [](const Vec3& p) { return p.cwiseAbs().maxCoeff() < 1.0; });
  for (Eigen::Index i = 0; i < ball.numPoints(); ++i) {
    const Vec3 p = ball.points.col(i);
    ball.points.col(i) = p.cwiseAbs().maxCoeff() * p.normalized();
  }
  return ball;
}

}  // namespace palpate::test
