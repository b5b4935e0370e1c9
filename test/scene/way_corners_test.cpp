// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/way_corners.h"

#include <gtest/gtest.h>

#include <cmath>

#include "palpate/mesh/size_field.h"

namespace palpate::scene::way_corners_test {
namespace {

double farthest(const std::vector<Vec3>& points, const std::vector<Vec3>& corners) {
  double most = 0.0;
  for (const Vec3& p : points) most = std::max(most, mesh::distanceTo(mesh::Polyline{corners}, p));
  return most;
}

TEST(WayCorners, OfAPointAndOfALineAreItsEnds) {
  EXPECT_EQ(wayCorners({Vec3(1, 2, 3)}, 0.1).size(), 1U);
  std::vector<Vec3> line;
  for (int i = 0; i <= 100; ++i) line.emplace_back(0.01 * i, 0.0, 0.0);
  const std::vector<Vec3> corners = wayCorners(line, 1e-6);
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_EQ(corners[0], line.front());
  EXPECT_EQ(corners[1], line.back());
}

TEST(WayCorners, AreInOrderAndNoPointIsFarFromThem) {
  std::vector<Vec3> way;
  for (int i = 0; i < 10000; ++i) {
    const double t = 1e-3 * i;
    way.emplace_back(t, std::sin(3.0 * t), std::cos(5.0 * t));
  }
  const std::vector<Vec3> corners = wayCorners(way, 0.01);
  EXPECT_LT(corners.size(), 400U);
  EXPECT_LE(farthest(way, corners), 0.01);
  for (std::size_t k = 1; k < corners.size(); ++k) EXPECT_GT(corners[k].x(), corners[k - 1].x());
}

// Of which the farthest point is always the next one: as deep and as slow as can be.
TEST(WayCorners, OfASpiralTakeNoDepthAndNoTime) {
  std::vector<Vec3> spiral;
  for (int i = 200000; i > 0; --i) {
    spiral.emplace_back(i * std::cos(0.001 * i), i * std::sin(0.001 * i), (i % 2) * 1.0 * i);
  }
  EXPECT_EQ(wayCorners(spiral, 1e-9).size(), spiral.size());
}

}  // namespace
}  // namespace palpate::scene::way_corners_test
