// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/remesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/mesh/surface_check.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/mesh/used_points.h"

namespace palpate::mesh::remesh_test {
namespace {

SurfaceMesh boxOf(const Vec3& size, const Eigen::Vector3i& cells) {
  const TetMesh block = boxMesh(size, cells);
  return onlyUsedPoints({block.points, trianglesOf(boundaryFaces(block))});
}

// Finer and coarser than it was: the box stays the box, to round-off.
TEST(Remesh, KeepsSharpEdges) {
  const Vec3 size(0.1, 0.1, 0.03);
  const SurfaceMesh box = boxOf(size, Eigen::Vector3i(10, 10, 3));
  for (const double edge : {0.005, 0.02}) {
    const SurfaceMesh made = remeshWithEdges(box, edge, 5);
    EXPECT_TRUE(checkSurface(made).ok());
    EXPECT_NEAR(enclosedVolume(made), size.prod(), 1e-9 * size.prod());
    double sum = 0.0, longest = 0.0;
    for (const auto& t : made.triangles.colwise()) {
      for (int k = 0; k < 3; ++k) {
        const double length = (made.points.col(t[k]) - made.points.col(t[(k + 1) % 3])).norm();
        sum += length;
        longest = std::max(longest, length);
      }
    }
    EXPECT_NEAR(sum / static_cast<double>(made.triangles.size()), edge, 0.25 * edge);
    EXPECT_LT(longest, 2.0 * edge);
    int corners = 0;
    for (const auto& X : made.points.colwise()) {
      corners += ((X.array() == 0.0) || (X.array() == size.array())).all();
    }
    EXPECT_EQ(corners, 8);
  }
}

TEST(Remesh, GivesTheSameBitsAgain) {
  const SurfaceMesh box = boxOf(Vec3::Ones(), Eigen::Vector3i(4, 4, 4));
  const SurfaceMesh a = remeshWithEdges(box, 0.3, 5), b = remeshWithEdges(box, 0.3, 5);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
}

}  // namespace
}  // namespace palpate::mesh::remesh_test
