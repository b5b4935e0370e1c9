// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/supports.h"

#include <gtest/gtest.h>

#include "palpate/mesh/tet_mesh.h"

namespace palpate::fem::supports_test {
namespace {

const Points kBox = mesh::boxMesh(Vec3::Ones(), Eigen::Vector3i::Constant(2)).points;

FreeMask hold(const std::vector<std::pair<int, int>>& components) {
  FreeMask free = FreeMask::Ones(3, kBox.cols());
  for (const auto& [c, i] : components) free(c, i) = 0.0;
  return free;
}

TEST(FreeRigidMotions, NamesAllSixOfAFreeBody) {
  const std::string motions = freeRigidMotions(kBox, hold({}));
  for (const char* name : {"translation along x", "translation along y", "translation along z",
                           "rotation about x", "rotation about y", "rotation about z"}) {
    EXPECT_NE(motions.find(name), std::string::npos) << motions;
  }
}

TEST(FreeRigidMotions, NamesTheRotationAboutAnAxisThatIsHeld) {
  FreeMask free = FreeMask::Ones(3, kBox.cols());
  for (Eigen::Index i = 0; i < kBox.cols(); ++i) {
    if (kBox(0, i) == 0.0 && kBox(1, i) == 0.0) free.col(i).setZero();
  }
  EXPECT_EQ(freeRigidMotions(kBox, free), "rotation about z");
}

TEST(FreeRigidMotions, IsSilentForThreeTwoOne) {
  // Nodes 0 (origin), 2 (1, 0, 0) and 6 (0, 1, 0) of the 3 x 3 x 3 nodes.
  EXPECT_EQ(freeRigidMotions(kBox, hold({{0, 0}, {1, 0}, {2, 0}, {1, 2}, {2, 2}, {2, 6}})), "");
}

}  // namespace
}  // namespace palpate::fem::supports_test
