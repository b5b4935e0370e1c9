// SPDX-License-Identifier: GPL-3.0-or-later
// What is no convex surface, and what is said of it.
#include "palpate/instrument/convex_hull.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "support/concave_surfaces.h"

namespace palpate::instrument::instrument_hull_test {
namespace {

std::string refusal(const mesh::SurfaceMesh& surface) {
  try {
    makeConvexHull(surface);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "";
}

mesh::SurfaceMesh cube() {
  return test::carved(Vec3(0.01, 0.01, 0.01), Eigen::Vector3i(2, 2, 2),
                      [](const Vec3&) { return true; });
}

TEST(InstrumentHull, IsOfOutwardTriangles) {
  EXPECT_EQ(refusal(cube()), "");
  EXPECT_EQ(refusal({}), "a convex hull needs triangles");

  mesh::SurfaceMesh inward = cube();
  inward.triangles.row(0).swap(inward.triangles.row(1));
  const char* const said = "the surface is not convex, or not oriented outward";
  EXPECT_EQ(refusal(inward), said);
  EXPECT_EQ(refusal(test::uSurface()), said);
}

TEST(InstrumentHull, IsOfFinitePoints) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    mesh::SurfaceMesh surface = cube();
    surface.points(1, 3) = value;
    EXPECT_EQ(refusal(surface), "a point is not finite");
  }
}

// A triangle without area has no normal of its own; it is as far out as the points are.
TEST(InstrumentHull, TakesTrianglesWithoutArea) {
  mesh::SurfaceMesh surface = cube();
  surface.triangles.conservativeResize(3, surface.triangles.cols() + 1);
  const int corner = surface.triangles(0, 0);
  surface.triangles.rightCols<1>().setConstant(corner);
  const ConvexHull hull = makeConvexHull(surface);
  EXPECT_TRUE(hull.normals.allFinite());
  const Eigen::VectorXd above =
      (hull.normals.transpose() * surface.points).rowwise().maxCoeff() - hull.offsets;
  EXPECT_LE(above.maxCoeff(), 1e-15);
}

}  // namespace
}  // namespace palpate::instrument::instrument_hull_test
