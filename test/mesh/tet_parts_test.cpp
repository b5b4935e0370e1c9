// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/tet_parts.h"

#include <gtest/gtest.h>

namespace palpate::mesh::tet_parts_test {
namespace {

// Two boxes, 50 mm apart, whose nodes and tetrahedra are mixed like cards.
TetMesh twoBoxes() {
  const TetMesh a = boxMesh(Vec3(0.1, 0.1, 0.04), Eigen::Vector3i(2, 3, 1));
  TetMesh b = boxMesh(Vec3(0.04, 0.04, 0.04), Eigen::Vector3i(2, 3, 1));
  b.points.row(0).array() += 0.15;
  TetMesh both;
  const Eigen::Index n = a.numPoints(), m = a.numTets();
  both.points.resize(3, 2 * n);
  both.tets.resize(4, 2 * m);
  Eigen::MatrixXd tag(1, 2 * m);
  for (Eigen::Index i = 0; i < n; ++i) {
    both.points.col(2 * i) = a.points.col(i);
    both.points.col(2 * i + 1) = b.points.col(i);
  }
  for (Eigen::Index t = 0; t < m; ++t) {
    both.tets.col(2 * t) = b.tets.col(t).array() * 2 + 1;
    both.tets.col(2 * t + 1) = a.tets.col(t).array() * 2;
    both.region.insert(both.region.end(), {7, 8});
    tag(0, 2 * t) = static_cast<double>(t);
    tag(0, 2 * t + 1) = -1.0;
  }
  both.cell_data["tag"] = tag;
  return both;
}

TEST(SplitParts, FindsThePartsAndWhereTheyWere) {
  const TetMesh both = twoBoxes();
  const std::vector<TetPart> parts = splitParts(both);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(parts[0].mesh.points.row(0).minCoeff(), 0.15, 1e-12);  // of the first tetrahedron
  EXPECT_EQ(parts[0].mesh.region, std::vector<int>(both.numTets() / 2, 7));
  EXPECT_EQ(parts[0].mesh.cell_data.at("tag")(0, 5), 5.0);
  EXPECT_EQ(parts[1].mesh.cell_data.at("tag").maxCoeff(), -1.0);
  for (const TetPart& part : parts) {
    ASSERT_EQ(part.mesh.numTets(), static_cast<Eigen::Index>(part.tets.size()));
    for (std::size_t t = 0; t < part.tets.size(); ++t) {
      for (int a = 0; a < 4; ++a) {
        EXPECT_EQ(part.nodes[part.mesh.tets(a, t)], both.tets(a, part.tets[t]));
      }
    }
    for (std::size_t i = 0; i < part.nodes.size(); ++i) {
      EXPECT_EQ(part.mesh.points.col(i), both.points.col(part.nodes[i]));
    }
  }
}

TEST(SplitParts, KeepsTheMiddlesOfEdges) {
  const TetMesh both = toQuadratic(twoBoxes());
  const std::vector<TetPart> parts = splitParts(both);
  ASSERT_EQ(parts.size(), 2u);
  Eigen::Index nodes = 0;
  for (const TetPart& part : parts) {
    ASSERT_TRUE(part.mesh.quadratic());
    nodes += part.mesh.numPoints();
    for (std::size_t t = 0; t < part.tets.size(); ++t) {
      for (int a = 0; a < 6; ++a) {
        EXPECT_EQ(part.nodes[part.mesh.midnodes(a, t)], both.midnodes(a, part.tets[t]));
      }
    }
  }
  EXPECT_EQ(nodes, both.numPoints());
}

TEST(SplitParts, OneBodyIsOnePartAndStrayNodesAreInNone) {
  TetMesh box = boxMesh(Vec3(0.1, 0.1, 0.04), Eigen::Vector3i(2, 2, 2));
  EXPECT_EQ(splitParts(box).size(), 1u);
  const Eigen::Index n = box.numPoints();
  box.points.conservativeResize(3, n + 1);
  box.points.col(n).setZero();
  ASSERT_EQ(splitParts(box).size(), 1u);
  EXPECT_EQ(splitParts(box)[0].mesh.numPoints(), n);
}

}  // namespace
}  // namespace palpate::mesh::tet_parts_test
