// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/convex_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <stdexcept>
#include <utility>

#include "palpate/instrument/convex_hull.h"

namespace palpate::mesh::convex_hull_test {
namespace {

Points cubeCorners() {
  Points p(3, 8);
  for (int i = 0; i < 8; ++i) p.col(i) = Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  return p;
}

/// Every edge twice, once in each direction.
bool closedAndOriented(const SurfaceMesh& surface) {
  std::map<std::pair<int, int>, int> edges;
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    for (int k = 0; k < 3; ++k) {
      ++edges[{surface.triangles(k, t), surface.triangles((k + 1) % 3, t)}];
    }
  }
  for (const auto& [edge, count] : edges) {
    if (count != 1 || edges.count({edge.second, edge.first}) != 1) return false;
  }
  return true;
}

TEST(ConvexHull, OfACubeWithPointsInsideAndOnIt) {
  Points points(3, 12);
  points.leftCols(8) = cubeCorners();
  points.col(8) = Vec3(0.5, 0.5, 0.5);
  points.col(9) = Vec3(0.5, 0.5, 1.0);   // on a face
  points.col(10) = Vec3(0.5, 0.0, 0.0);  // on an edge
  points.col(11) = Vec3(1.0, 1.0, 1.0);  // a corner again
  const SurfaceMesh hull = convexHull(points);
  EXPECT_TRUE(closedAndOriented(hull));
  EXPECT_NEAR(enclosedVolume(hull), 1.0, 1e-14);
  EXPECT_EQ(hull.points.cols(), 8);
  EXPECT_EQ(hull.triangles.cols(), 12);
}

TEST(ConvexHull, HoldsAllPoints) {
  std::mt19937 rng{7};
  std::normal_distribution<double> gauss;
  const Points points = 0.01 * Points::NullaryExpr(3, 500, [&] { return gauss(rng); });
  const SurfaceMesh hull = convexHull(points);
  EXPECT_TRUE(closedAndOriented(hull));
  const instrument::ConvexHull shape = instrument::makeConvexHull(hull);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    EXPECT_LT((shape.normals.transpose() * points.col(i) - shape.offsets).maxCoeff(), 1e-15);
  }
}

TEST(ConvexHull, RefusesPointsWithoutVolume) {
  EXPECT_THROW(convexHull(Points(3, 0)), std::invalid_argument);
  EXPECT_THROW(convexHull(Points::Zero(3, 3)), std::invalid_argument);
  EXPECT_THROW(convexHull(Points::Ones(3, 10)), std::invalid_argument);
  Points line(3, 5), plane = cubeCorners(), tilted = cubeCorners();
  for (int i = 0; i < 5; ++i) line.col(i) = i * Vec3(1.0, 2.0, 3.0);
  plane.row(2).setConstant(0.3);
  tilted.row(2) = 0.1 * tilted.row(0) + 0.7 * tilted.row(1);  // flat up to rounding
  EXPECT_THROW(convexHull(line), std::invalid_argument);
  EXPECT_THROW(convexHull(plane), std::invalid_argument);
  EXPECT_THROW(convexHull(tilted), std::invalid_argument);
}

TEST(ConvexHull, RefusesNonFinitePoints) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Points points = cubeCorners();
    points(1, 3) = bad;
    EXPECT_THROW(convexHull(points), std::invalid_argument);
  }
}

TEST(CollisionHull, HasOutwardUnitPlanes) {
  const instrument::ConvexHull hull = instrument::makeConvexHull(convexHull(cubeCorners()));
  for (Eigen::Index t = 0; t < hull.offsets.size(); ++t) {
    EXPECT_NEAR(hull.normals.col(t).norm(), 1.0, 1e-15);
    EXPECT_NEAR(hull.normals.col(t).cwiseAbs().maxCoeff(), 1.0, 1e-15);
    EXPECT_NEAR(hull.normals.col(t).dot(Vec3(0.5, 0.5, 0.5)) - hull.offsets[t], -0.5, 1e-15);
  }
}

TEST(CollisionHull, RefusesWhatIsNotConvexOrInsideOut) {
  SurfaceMesh inside_out = convexHull(cubeCorners());
  inside_out.triangles.row(0).swap(inside_out.triangles.row(1));
  EXPECT_THROW(instrument::makeConvexHull(inside_out), std::invalid_argument);
  SurfaceMesh dented = convexHull(cubeCorners());
  dented.points.col(0) = Vec3(0.45, 0.45, 0.45);
  EXPECT_THROW(instrument::makeConvexHull(dented), std::invalid_argument);
  EXPECT_THROW(instrument::makeConvexHull(SurfaceMesh()), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::mesh::convex_hull_test
