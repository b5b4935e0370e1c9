// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::test {

/// The surface of those cubes of a block, `size` [m] large from the origin on, whose middle
/// `keep(middle)` wants.
template <class Keep>
mesh::SurfaceMesh carved(const Vec3& size, const Eigen::Vector3i& cubes, const Keep& keep) {
  const mesh::TetMesh block = mesh::boxMesh(size, cubes);
  const Vec3 edge = size.cwiseQuotient(cubes.cast<double>());
  std::vector<Eigen::Vector4i> kept;
  for (int t = 0; t < block.numTets(); ++t) {
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < 4; ++k) center += 0.25 * block.points.col(block.tets(k, t));
    const Vec3 cube = center.cwiseQuotient(edge).array().floor();
    if (keep(Vec3((cube.array() + 0.5) * edge.array()))) kept.emplace_back(block.tets.col(t));
  }
  Eigen::Matrix4Xi tets(4, static_cast<Eigen::Index>(kept.size()));
  for (std::size_t t = 0; t < kept.size(); ++t) tets.col(static_cast<Eigen::Index>(t)) = kept[t];
  mesh::SurfaceMesh surface{block.points, mesh::boundaryTriangles(tets)};
  std::vector<int> number(static_cast<std::size_t>(block.numPoints()), -1);
  int count = 0;
  for (int& corner : surface.triangles.reshaped()) {
    int& now = number[static_cast<std::size_t>(corner)];
    if (now < 0) {
      now = count++;
      surface.points.col(now) = block.points.col(corner);
    }
    corner = now;
  }
  surface.points.conservativeResize(3, count);
  return surface;
}

/// A U, 15 x 5 x 15 mm, open upwards (+z): walls and floor are 5 mm thick.
inline mesh::SurfaceMesh uSurface() {
  return carved(Vec3(0.015, 0.005, 0.015), Eigen::Vector3i(3, 1, 3),
                [](const Vec3& p) { return p.z() < 0.005 || p.x() < 0.005 || p.x() > 0.010; });
}

/// A hook, 20 x 4 x 20 mm, 4 mm thick: a shaft, an arm at its top and a tip that hangs down.
inline mesh::SurfaceMesh hookSurface() {
  return carved(Vec3(0.020, 0.004, 0.020), Eigen::Vector3i(5, 1, 5), [](const Vec3& p) {
    return p.x() < 0.004 || p.z() > 0.016 || (p.x() > 0.016 && p.z() > 0.008);
  });
}

/// A ring about the z axis whose wire has the radius `wire` [m], its middle line `ring`.
inline mesh::SurfaceMesh ringSurface(double ring, double wire, int around, int across) {
  mesh::SurfaceMesh surface{Points(3, around * across), Eigen::Matrix3Xi(3, 2 * around * across)};
  const auto at = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i) {
    const double a = 2.0 * EIGEN_PI * i / around;
    for (int j = 0; j < across; ++j) {
      const double b = 2.0 * EIGEN_PI * j / across, r = ring + wire * std::cos(b);
      surface.points.col(at(i, j)) = Vec3(r * std::cos(a), r * std::sin(a), wire * std::sin(b));
      surface.triangles.col(2 * at(i, j)) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
      surface.triangles.col(2 * at(i, j) + 1) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
    }
  }
  return surface;
}

}  // namespace palpate::test
