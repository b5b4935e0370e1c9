// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/cavities.h"

#include <gtest/gtest.h>

#include "support/hollow.h"

namespace palpate::mesh::cavities_test {
namespace {

TEST(Cavities, AreNoneInASolidBody) {
  EXPECT_TRUE(cavityNodes(boxMesh(Vec3::Ones(), Eigen::Vector3i::Constant(3))).empty());
}

TEST(Cavities, HaveTheNodesOfTheirWall) {
  const TetMesh cube = test::hollowCube();
  const auto cavities = cavityNodes(cube);
  ASSERT_EQ(cavities.size(), 1u);
  EXPECT_EQ(cavities[0].size(), 26u);  // of 3 x 3 x 3 all but the middle
  for (const int i : cavities[0]) {
    EXPECT_NEAR((cube.points.col(i).array() - 0.03).abs().maxCoeff(), 0.01, 1e-12);
  }
  // With the middle nodes of edges: 6 faces of 8 triangles, 72 edges.
  EXPECT_EQ(cavityNodes(toQuadratic(cube))[0].size(), 26u + 72u);
}

TEST(Cavities, AreOrderedByTheirSize) {
  const auto in = [](const Vec3& p, double low, double high) {
    return p.x() > low && p.x() < high && (p.tail<2>().array() > 1.0).all() &&
           (p.tail<2>().array() < 2.0).all();
  };
  const TetMesh two = test::without(boxMesh(Vec3(7.0, 3.0, 3.0), Eigen::Vector3i(7, 3, 3)),
                                    [&](const Vec3& p) { return in(p, 1, 2) || in(p, 4, 6); });
  const auto cavities = cavityNodes(two);
  ASSERT_EQ(cavities.size(), 2u);
  EXPECT_EQ(cavities[0].size(), 12u);
  EXPECT_EQ(cavities[1].size(), 8u);
}

}  // namespace
}  // namespace palpate::mesh::cavities_test
