// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "mesh/surfaces.h"
#include "palpate/base/error.h"
#include "palpate/mesh/surface_check.h"

namespace palpate::mesh::surface_repair_test {
namespace {

constexpr double kVolume = 1e-3;  // [m^3] of the box

SurfaceMesh box() { return boxSurface(0.1, 5); }  // 300 triangles

std::string refusal(const SurfaceMesh& surface) {
  try {
    repairSurface(surface, "organ.stl");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Repairs, expects a sound box, and returns the one sentence that was reported.
std::string repair(const SurfaceMesh& surface, double volume = kVolume) {
  SurfaceReport report;
  const SurfaceMesh mended = repairSurface(surface, "organ.stl", &report);
  EXPECT_TRUE(report.ok());
  EXPECT_TRUE(checkSurface(mended).ok());
  EXPECT_EQ(report.duplicate_points + report.isolated_points + report.duplicate_triangles, 0);
  EXPECT_NEAR(enclosedVolume(mended), volume, 1e-12);
  std::string all;
  for (const std::string& sentence : report.repairs) all += (all.empty() ? "" : "; ") + sentence;
  return all;
}

TEST(SurfaceRepair, LeavesASoundSurfaceAlone) {
  SurfaceReport report;
  const SurfaceMesh before = box(), after = repairSurface(before, "organ.stl", &report);
  EXPECT_EQ(before.points, after.points);
  EXPECT_EQ(before.triangles, after.triangles);
  EXPECT_TRUE(report.repairs.empty());
}

TEST(SurfaceRepair, MergesTheCornersOfSeparateTriangles) {
  const SurfaceMesh whole = box();
  SurfaceMesh soup;  // as in an STL file
  soup.points.resize(3, 3 * whole.triangles.cols());
  soup.triangles.resize(3, whole.triangles.cols());
  for (Eigen::Index c = 0; c < whole.triangles.size(); ++c) {
    soup.points.col(c) = whole.points.col(whole.triangles(c % 3, c / 3));
    soup.triangles(c % 3, c / 3) = static_cast<int>(c);
  }
  EXPECT_EQ(repair(soup), "merged 748 points with another in the same place");
}

TEST(SurfaceRepair, TurnsFlippedTriangles) {
  SurfaceMesh surface = box();
  for (const int t : {3, 4, 100}) flip(&surface, t);
  EXPECT_EQ(repair(surface), "turned 3 triangles to face outward");
}

TEST(SurfaceRepair, TurnsASurfaceInsideOut) {
  SurfaceMesh surface = box();
  flipAll(&surface);
  EXPECT_EQ(repair(surface), "turned 300 triangles to face outward");
}

TEST(SurfaceRepair, TurnsACavityInward) {
  SurfaceMesh cavity = moved(boxSurface(0.02, 2), Vec3(0.04, 0.04, 0.04));
  EXPECT_EQ(repair(joined(box(), cavity), kVolume - 8e-6), "turned 48 triangles to face outward");
}

TEST(SurfaceRepair, FillsASmallHole) {
  SurfaceMesh surface = box();
  removeLastTriangles(&surface, 1);
  EXPECT_EQ(repair(surface), "filled 1 hole with 1 triangle");
}

TEST(SurfaceRepair, RemovesDegenerateTriangles) {
  SurfaceMesh surface = box();
  surface.triangles.conservativeResize(3, surface.triangles.cols() + 1);
  surface.triangles.rightCols<1>() = Eigen::Vector3i(7, 7, 8);
  EXPECT_EQ(repair(surface), "removed 1 triangle without area");
}

TEST(SurfaceRepair, RemovesATriangleWhoseCornersAreInLine) {
  SurfaceMesh surface = box();
  // An edge gets a corner on its middle for one of its triangles; a flat triangle closes the gap.
  const Eigen::Vector3i t = surface.triangles.col(0);
  const auto middle = static_cast<int>(surface.points.cols());
  surface.points.conservativeResize(3, middle + 1);
  surface.points.col(middle) = 0.5 * (surface.points.col(t[0]) + surface.points.col(t[1]));
  const Eigen::Index n = surface.triangles.cols();
  surface.triangles.conservativeResize(3, n + 2);
  surface.triangles.col(0) = Eigen::Vector3i(t[0], middle, t[2]);
  surface.triangles.col(n) = Eigen::Vector3i(middle, t[1], t[2]);
  surface.triangles.col(n + 1) = Eigen::Vector3i(t[0], t[1], middle);
  ASSERT_EQ(checkSurface(surface).degenerate_triangles, 1);
  ASSERT_TRUE(checkSurface(surface).closed);
  EXPECT_EQ(repair(surface), "removed 1 triangle without area");
}

TEST(SurfaceRepair, RemovesTriangleAndPointDoubles) {
  SurfaceMesh surface = box();
  surface.triangles.conservativeResize(3, surface.triangles.cols() + 1);
  surface.triangles.rightCols<1>() = surface.triangles.col(9).eval();
  surface.points.conservativeResize(3, surface.points.cols() + 1);
  surface.points.rightCols<1>() = Vec3(0.5, 0.5, 0.5);
  EXPECT_EQ(repair(surface),
            "removed 1 triangle that stood there twice; removed 1 point of no triangle");
}

TEST(SurfaceRepair, ReplacesAFold) {
  // On a finely cut side, one point is pushed under the surface into a pit at another.
  SurfaceMesh surface = boxSurface(0.1, 20);
  const auto nearest = [&](const Vec3& to) {
    Eigen::Index point = 0;
    (surface.points.colwise() - to).colwise().norm().minCoeff(&point);
    return surface.points.col(point);
  };
  nearest(Vec3(0.060, 0.05, 0.1)) -= Vec3(0.0, 0.0, 0.006);
  nearest(Vec3(0.050, 0.05, 0.1)) += Vec3(0.011, 0.001, -0.003);
  ASSERT_GT(checkSurface(surface).self_intersecting_triangles, 0);
  SurfaceReport report;
  const SurfaceMesh mended = repairSurface(surface, "organ.stl", &report);
  EXPECT_TRUE(report.ok());
  ASSERT_EQ(report.repairs.size(), 1U);
  EXPECT_TRUE(says(report.repairs[0], "that cut others")) << report.repairs[0];
  EXPECT_NEAR(enclosedVolume(mended), kVolume, 1e-6);
}

TEST(SurfaceRepair, RefusesAnOpenSurfaceWithItsEdges) {
  SurfaceMesh surface = boxSurface(0.1, 1);
  removeLastTriangles(&surface, 2);
  const std::string text = refusal(surface);
  EXPECT_TRUE(says(text, "organ.stl: ")) << text;
  EXPECT_TRUE(says(text, "open: 4 edges")) << text;
}

TEST(SurfaceRepair, RefusesBodiesThatShareAnEdge) {
  const SurfaceMesh two = joined(boxSurface(0.1, 1), moved(boxSurface(0.1, 1), Vec3(0.1, 0.1, 0)));
  const std::string text = refusal(two);
  EXPECT_TRUE(says(text, "not manifold: 1 edge with more than two triangles (4 triangles)"))
      << text;
}

TEST(SurfaceRepair, RefusesASurfaceThatCutsItself) {
  const SurfaceMesh two =
      joined(boxSurface(0.1, 1), moved(boxSurface(0.1, 1), Vec3(0.05, 0.04, 0.03)));
  const std::string text = refusal(two);
  EXPECT_TRUE(says(text, "cuts itself: ")) << text;
  const int cutting = checkSurface(two).self_intersecting_triangles;
  EXPECT_TRUE(says(text, std::to_string(cutting) + " triangles")) << text;
}

TEST(SurfaceRepair, RefusesWhatIsNoSurface) {
  EXPECT_TRUE(says(refusal(SurfaceMesh()), "no triangle"));
  SurfaceMesh bad = box();
  bad.triangles(1, 4) = 100000;
  bad.points(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(says(refusal(bad), "none of the 152 points")) << refusal(bad);
  EXPECT_TRUE(says(refusal(bad), "finite")) << refusal(bad);
  bad = box();
  bad.triangles(1, 4) = -1;
  EXPECT_TRUE(says(refusal(bad), "none of the 152 points"));
  bad = box();
  bad.points.setConstant(0.1);
  EXPECT_TRUE(says(refusal(bad), "no triangle of the surface has an area")) << refusal(bad);
}

}  // namespace
}  // namespace palpate::mesh::surface_repair_test
