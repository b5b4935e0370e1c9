// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/press_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "palpate/mesh/tet_mesh.h"

namespace palpate::enrichment::press_plan_test {
namespace {

mesh::SurfaceMesh cube() {
  const mesh::TetMesh mesh = mesh::boxMesh(Vec3::Ones(), Eigen::Vector3i::Constant(4));
  return {mesh.points, mesh::trianglesOf(mesh::boundaryFaces(mesh))};
}

TEST(PressPlan, PressesInwardWithinItsConeAndForce) {
  const mesh::SurfaceMesh surface = cube();
  std::vector<int> top;  // but for its edges
  for (int i = 0; i < surface.points.cols(); ++i) {
    const Vec3 X = surface.points.col(i);
    if (X.z() > 0.99 && std::max(std::abs(X.x() - 0.5), std::abs(X.y() - 0.5)) < 0.4) {
      top.push_back(i);
    }
  }
  ASSERT_EQ(top.size(), 9U);
  const PressPlan plan{3, 2.0, 0.5};
  std::set<int> pressed;
  double smallest = 9.0, largest = 0.0, straightest = 9.0, slantest = 0.0;
  for (int index = 0; index < 500; ++index) {
    const Deformation press = drawPress(plan, surface, top, index);
    EXPECT_EQ(drawPress(plan, surface, top, index).force, press.force);
    pressed.insert(press.contact);
    const double size = press.force.norm(), angle = std::acos(-press.force.z() / size);
    smallest = std::min(smallest, size);
    largest = std::max(largest, size);
    straightest = std::min(straightest, angle);
    slantest = std::max(slantest, angle);
  }
  EXPECT_EQ(pressed, std::set<int>(top.begin(), top.end()));
  EXPECT_GE(smallest, 0.5);
  EXPECT_LT(smallest, 0.53);
  EXPECT_LT(largest, 2.0);
  EXPECT_GT(largest, 1.97);
  EXPECT_LT(straightest, 0.05);
  EXPECT_LT(slantest, 0.5);
  EXPECT_GT(slantest, 0.48);
}

TEST(PressPlan, DrawsOtherPressesForAnotherSeedAndIndex) {
  const mesh::SurfaceMesh surface = cube();
  const std::vector<int> all{0, 1, 2, 3, 4, 5, 6, 7};
  std::set<double> sizes;
  for (int seed = 0; seed < 10; ++seed) {
    for (int index = 0; index < 10; ++index) {
      sizes.insert(drawPress({seed, 1.0, 0.5}, surface, all, index).force.norm());
    }
  }
  EXPECT_EQ(sizes.size(), 100U);
}

}  // namespace
}  // namespace palpate::enrichment::press_plan_test
