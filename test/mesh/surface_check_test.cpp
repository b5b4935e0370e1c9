// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/surface_check.h"

#include <gtest/gtest.h>

#include "mesh/surfaces.h"

namespace palpate::mesh::surface_check_test {
namespace {

TEST(SurfaceCheck, PassesABox) {
  const SurfaceReport report = checkSurface(boxSurface(0.1, 3));
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.triangles, 108);
  EXPECT_EQ(report.points, 56);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.boundary_edges + report.nonmanifold_edges + report.nonmanifold_points +
                report.misoriented_edges + report.duplicate_points + report.isolated_points +
                report.duplicate_triangles + report.degenerate_triangles,
            0);
}

TEST(SurfaceCheck, NothingIsNotASurface) {
  const SurfaceReport report = checkSurface(SurfaceMesh());
  EXPECT_FALSE(report.closed);
  EXPECT_FALSE(report.ok());
}

TEST(SurfaceCheck, CountsTheRimOfAHole) {
  SurfaceMesh box = boxSurface(0.1, 3);
  removeLastTriangles(&box, 1);
  const SurfaceReport report = checkSurface(box);
  EXPECT_FALSE(report.closed);
  EXPECT_FALSE(report.oriented);
  EXPECT_TRUE(report.manifold);
  EXPECT_EQ(report.boundary_edges, 3);
}

TEST(SurfaceCheck, CountsTheEdgesOfAFlippedTriangle) {
  SurfaceMesh box = boxSurface(0.1, 3);
  flip(&box, 5);
  const SurfaceReport report = checkSurface(box);
  EXPECT_FALSE(report.oriented);
  EXPECT_EQ(report.misoriented_edges, 3);
}

TEST(SurfaceCheck, ABoxInsideOutIsNotOriented) {
  SurfaceMesh box = boxSurface(0.1, 3);
  flipAll(&box);
  const SurfaceReport report = checkSurface(box);
  EXPECT_TRUE(report.closed);
  EXPECT_FALSE(report.oriented);
  EXPECT_EQ(report.misoriented_edges, 0);
}

TEST(SurfaceCheck, CountsAFinOnAnEdge) {
  SurfaceMesh box = boxSurface(0.1, 3);
  const Eigen::Vector3i t = box.triangles.col(0);
  box.points.conservativeResize(3, box.points.cols() + 1);
  box.points.rightCols<1>() = Vec3(1.0, 1.0, 1.0);
  box.triangles.conservativeResize(3, box.triangles.cols() + 1);
  box.triangles.rightCols<1>() =
      Eigen::Vector3i(t[0], t[1], static_cast<int>(box.points.cols()) - 1);
  const SurfaceReport report = checkSurface(box);
  EXPECT_FALSE(report.manifold);
  EXPECT_EQ(report.nonmanifold_edges, 1);
  EXPECT_EQ(report.nonmanifold_triangles, 3);
}

TEST(SurfaceCheck, CountsPointsWhereBodiesTouch) {
  SurfaceMesh two = joined(boxSurface(0.1, 2), moved(boxSurface(0.1, 2), Vec3(0.1, 0.1, 0.1)));
  // The second box takes the corner of the first one at (0.1, 0.1, 0.1).
  Eigen::Index a = 0, b = 0;
  const auto half = two.points.cols() / 2;
  const Vec3 corner(0.1, 0.1, 0.1);
  (two.points.leftCols(half).colwise() - corner).colwise().norm().minCoeff(&a);
  (two.points.rightCols(half).colwise() - corner).colwise().norm().minCoeff(&b);
  for (Eigen::Index c = 0; c < two.triangles.size(); ++c) {
    int& index = two.triangles(c % 3, c / 3);
    if (index == b + half) index = static_cast<int>(a);
  }
  const SurfaceReport report = checkSurface(two);
  EXPECT_EQ(report.nonmanifold_points, 1);
  EXPECT_EQ(report.components, 2);
  EXPECT_EQ(report.isolated_points, 1);
  EXPECT_FALSE(report.manifold);
}

TEST(SurfaceCheck, CountsDoubles) {
  SurfaceMesh box = boxSurface(0.1, 3);
  box.triangles.conservativeResize(3, box.triangles.cols() + 2);
  box.triangles.rightCols<2>() << box.triangles(1, 7), 0,  // the same, begun elsewhere
      box.triangles(2, 7), 0,                              //
      box.triangles(0, 7), 1;                              // and one without area
  box.points.conservativeResize(3, box.points.cols() + 1);
  box.points.rightCols<1>() = box.points.col(4).eval();
  const SurfaceReport report = checkSurface(box);
  EXPECT_EQ(report.duplicate_triangles, 1);
  EXPECT_EQ(report.degenerate_triangles, 1);
  EXPECT_EQ(report.duplicate_points, 1);
  EXPECT_EQ(report.isolated_points, 1);
}

TEST(SurfaceCheck, FindsBoxesThatCutEachOther) {
  const SurfaceMesh two =
      joined(boxSurface(0.1, 1), moved(boxSurface(0.1, 1), Vec3(0.05, 0.04, 0.03)));
  const SurfaceReport report = checkSurface(two);
  EXPECT_EQ(report.components, 2);
  EXPECT_GE(report.self_intersecting_triangles, 6);
  EXPECT_LE(report.self_intersecting_triangles, 24);
  EXPECT_FALSE(report.ok());
}

}  // namespace
}  // namespace palpate::mesh::surface_check_test
