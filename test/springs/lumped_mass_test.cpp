// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/lumped_mass.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "palpate/mesh/tet_mesh.h"
#include "support/contains.h"
#include "support/random.h"

namespace palpate::springs::lumped_mass_test {
namespace {

// Sums of a few hundred terms: some units in the last place.
constexpr double kRoundoff = 1e-14;

template <class F>
std::string refusal(F&& f) {
  try {
    f();
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

TEST(LumpedMass, TrianglesGiveAThirdToEachCorner) {
  Points points(3, 4);
  points << 0, 1, 1, 0, 0, 0, 2, 2, 0, 0, 0, 0;
  Eigen::Matrix3Xi triangles(3, 2);
  triangles << 0, 0, 1, 2, 2, 3;
  EXPECT_TRUE(triangleShares(points, triangles)
                  .isApprox(Eigen::Vector4d(2.0 / 3, 1.0 / 3, 2.0 / 3, 1.0 / 3), kRoundoff));
  triangles(2, 1) = 2;
  EXPECT_TRUE(test::contains(refusal([&] { triangleShares(points, triangles); }),
                             "triangle 1: is collapsed"));
  triangles(2, 1) = 4;
  EXPECT_TRUE(test::contains(refusal([&] { triangleShares(points, triangles); }),
                             "triangle 1: a corner is none of the 4 points"));
}

TEST(LumpedMass, RectanglesGiveAQuarterToEachCorner) {
  Points points(3, 6);
  points << 0, 1, 3, 0, 1, 3, 0, 0, 0, 2, 2, 2, 0, 0, 0, 0, 0, 0;
  Eigen::Matrix4Xi rectangles(4, 2);
  rectangles << 0, 1, 1, 2, 4, 5, 3, 4;
  Eigen::VectorXd expected(6);
  expected << 0.5, 1.5, 1.0, 0.5, 1.5, 1.0;
  EXPECT_TRUE(rectangleShares(points, rectangles).isApprox(expected, kRoundoff));
}

TEST(LumpedMass, TheSumIsTheWholeInAnyFrame) {
  test::Random random;
  mesh::TetMesh box = mesh::boxMesh(Vec3(0.1, 0.2, 0.3), {3, 4, 5});
  const double volume = 0.1 * 0.2 * 0.3;
  EXPECT_NEAR(tetShares(box.points, box.tets).sum(), volume, kRoundoff * volume);
  const Mat3 R = random.rotation();
  const Points turned = (R * box.points).colwise() + random.vector(1.0);
  EXPECT_NEAR(tetShares(turned, box.tets).sum(), volume, 10 * kRoundoff * volume);
  EXPECT_TRUE(tetShares(turned, box.tets).isApprox(tetShares(box.points, box.tets), 1e-12));
  box.points.col(box.tets(0, 7)) = box.points.col(box.tets(1, 7));
  EXPECT_NE(refusal([&] { tetShares(box.points, box.tets); }), "");
}

}  // namespace
}  // namespace palpate::springs::lumped_mass_test
