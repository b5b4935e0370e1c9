// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/canonical_order.h"

#include <gtest/gtest.h>

namespace palpate::mesh::canonical_order_test {
namespace {

/// The same mesh with its points, tetrahedra and corners in another order.
TetMesh shuffled(const TetMesh& mesh) {
  const auto n = static_cast<int>(mesh.numPoints()), m = static_cast<int>(mesh.numTets());
  TetMesh other = mesh;
  const auto renamed = [n](int i) { return static_cast<int>((7919LL * i + 5) % n); };
  for (int i = 0; i < n; ++i) other.points.col(renamed(i)) = mesh.points.col(i);
  for (int t = 0; t < m; ++t) {
    const Eigen::Vector4i v = mesh.tets.col(t).unaryExpr(renamed);
    other.tets.col((104729LL * t + 1) % m) = Eigen::Vector4i(v[2], v[0], v[1], v[3]);
  }
  return other;
}

TEST(CanonicalOrder, ForgetsTheOrderOfTheInput) {
  TetMesh a = boxMesh(Vec3(0.3, 0.2, 0.1), {5, 4, 3});
  TetMesh b = shuffled(a);
  ASSERT_NE(a.points, b.points);
  orderCanonically(&a);
  orderCanonically(&b);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.tets, b.tets);
}

TEST(CanonicalOrder, KeepsTheBodyAndThePositiveVolumes) {
  TetMesh mesh = boxMesh(Vec3(0.3, 0.2, 0.1), {5, 4, 3});
  mesh.tets.row(0).swap(mesh.tets.row(1));  // all inverted
  orderCanonically(&mesh);
  double volume = 0.0;
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    const double v = signedVolume(mesh.points, mesh.tets.col(t));
    EXPECT_GT(v, 0.0);
    volume += v;
  }
  EXPECT_NEAR(volume, 0.006, 1e-15);
}

TEST(CanonicalOrder, FollowsAHilbertCurve) {
  TetMesh mesh = boxMesh(Vec3::Ones(), {7, 7, 7});  // 8 x 8 x 8 points
  orderCanonically(&mesh);
  for (Eigen::Index i = 1; i < mesh.numPoints(); ++i) {
    ASSERT_NEAR((mesh.points.col(i) - mesh.points.col(i - 1)).norm(), 1.0 / 7.0, 1e-12) << i;
  }
}

}  // namespace
}  // namespace palpate::mesh::canonical_order_test
