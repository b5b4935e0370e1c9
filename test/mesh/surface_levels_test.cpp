// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/surface_levels.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "palpate/mesh/surface_check.h"
#include "palpate/organs/organs.h"

namespace palpate::mesh::surface_levels_test {
namespace {

TEST(SurfaceLevels, SimplifyToAsManyTrianglesOfTheSameShape) {
  const SurfaceMesh liver = organs::makeOrgan("liver", 0.01);
  const SurfaceMesh coarse = simplify(liver, 276);
  EXPECT_EQ(coarse.triangles.cols(), 276);
  EXPECT_EQ(coarse.points.cols(), 140);
  EXPECT_NEAR(enclosedVolume(coarse) / enclosedVolume(liver), 1.0, 0.05);
  const SurfaceMesh again = simplify(liver, 276);
  EXPECT_EQ(again.points, coarse.points);
  EXPECT_EQ(again.triangles, coarse.triangles);
}

TEST(SurfaceLevels, SplitKeepsPointsAndVolume) {
  const SurfaceMesh coarse = simplify(organs::makeOrgan("liver", 0.01), 276);
  const SurfaceMesh fine = splitTriangles(splitTriangles(coarse));
  EXPECT_EQ(fine.points.cols(), 2210);
  EXPECT_EQ(fine.triangles.cols(), 4416);
  EXPECT_EQ(fine.points.leftCols(140), coarse.points);
  EXPECT_NEAR(enclosedVolume(fine), enclosedVolume(coarse), 1e-12);
}

TEST(SurfaceLevels, MovesPointsOntoTheNearestPlace) {
  const SurfaceMesh slab = organs::makeOrgan("slab", 0.02);
  Points points(3, 2);
  points << 0.01, 0.01, 0.0, 0.0, 0.1, 0.1;
  moveOnto(slab, 1, &points);
  EXPECT_EQ(points.col(0), Vec3(0.01, 0.0, 0.1));
  EXPECT_NEAR((points.col(1) - Vec3(0.01, 0.0, 0.03)).norm(), 0.0, 1e-12);
}

TEST(SurfaceLevels, RefusesWhatCannotBe) {
  const SurfaceMesh slab = organs::makeOrgan("slab", 0.02);
  EXPECT_THROW(simplify(slab, 277), std::invalid_argument);
  EXPECT_THROW(simplify(slab, 2), std::invalid_argument);
  SurfaceMesh open = slab;
  open.triangles.conservativeResize(3, open.triangles.cols() - 1);
  EXPECT_THROW(simplify(open, 100), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::mesh::surface_levels_test
