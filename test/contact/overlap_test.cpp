// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/overlap.h"

#include <gtest/gtest.h>

#include "palpate/contact/signed_distance.h"
#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/tet_mesh.h"
#include "test_shapes.h"

namespace palpate::contact::overlap_test {
namespace {

const mesh::TetMesh kBlock = mesh::boxMesh(Vec3(0.06, 0.05, 0.04), Eigen::Vector3i(3, 2, 2));
const Eigen::Matrix3Xi kSurface = mesh::boundaryTriangles(kBlock.tets);
const Vec3 kMiddle(0.03, 0.025, 0.02);

bool inBlock(const Vec3& p) {
  return (p.array() > 0.0).all() && (p.array() < Vec3(0.06, 0.05, 0.04).array()).all();
}

TEST(WindingNumber, IsOneInsideAndZeroOutside) {
  std::mt19937 rng{1};
  const Points points = randomPoints(&rng, 300, 0.035);
  int inside = 0;
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    const Vec3 p = kMiddle + Vec3(points.col(k));
    EXPECT_NEAR(windingNumber(kBlock.points, kSurface, p), inBlock(p) ? 1.0 : 0.0, 1e-9);
    inside += inBlock(p);
  }
  EXPECT_GT(inside, 20);
}

// Against points strewn over the block's surface and inside of it.
TEST(Overlap, IsFoundWhereverAShapeIsInTheBody) {
  std::mt19937 rng{2};
  std::uniform_real_distribution<double> u(0.0, 1.0);
  Points strewn(3, 30000);
  for (Eigen::Index k = 0; k < strewn.cols(); ++k) {
    strewn.col(k) = Vec3(0.06 * u(rng), 0.05 * u(rng), 0.04 * u(rng));
    if (k % 2) strewn(k % 3, k) = u(rng) < 0.5 ? 0.0 : 2.0 * kMiddle[k % 3];
  }
  for (const auto& [name, geometry] : testShapes()) {
    int yes = 0, no = 0;
    for (int trial = 0; trial < 100; ++trial) {
      Pose X_WG = randomPose(&rng, 0.05);
      X_WG.translation() += kMiddle;
      double least = 1.0;
      for (Eigen::Index k = 0; k < strewn.cols(); ++k) {
        least = std::min(least, signedDistanceValue(geometry, X_WG.inverse() * strewn.col(k)));
      }
      const bool found = overlaps(geometry, X_WG, kBlock.points, kSurface);
      if (least < 0.0) {
        EXPECT_TRUE(found) << name;
      }
      if (least > 0.1 * inscribedRadius(geometry) + 2e-3) {
        EXPECT_FALSE(found) << name;
      }
      (found ? yes : no)++;
    }
    EXPECT_GT(yes, 10) << name;
    EXPECT_GT(no, 10) << name;
  }
}

TEST(Overlap, SeesAToolThatIsInsideAndABodyThatIsInsideOfTheTool) {
  Pose X_WG = Pose::Identity();
  X_WG.translation() = kMiddle;
  EXPECT_TRUE(overlaps(instrument::Sphere{0.001}, X_WG, kBlock.points, kSurface));
  EXPECT_TRUE(overlaps(instrument::Sphere{1.0}, X_WG, kBlock.points, kSurface));
}

// Its inscribed radius is zero, so no triangle is small enough in comparison.
TEST(Overlap, EndsForAHullWithoutAnInside) {
  instrument::ConvexHull flat = hullOfBox(Vec3(0.01, 0.01, 1e-9), Vec3::Zero());
  flat.offsets.setZero();
  Pose X_WG = Pose::Identity();
  X_WG.translation() = kMiddle;
  EXPECT_EQ(inscribedRadius(flat), 0.0);
  overlaps(flat, X_WG, kBlock.points, kSurface);
  X_WG.translation().z() = 0.04;  // in the top
  EXPECT_TRUE(overlaps(flat, X_WG, kBlock.points, kSurface));
}

TEST(Overlap, KeepsTheMargin) {
  Pose X_WG = Pose::Identity();
  X_WG.translation() = kMiddle + Vec3(0.0, 0.0, 0.02 + 0.005 + 0.002);  // 2 mm above, mid-triangle
  const instrument::Geometry ball = instrument::Sphere{0.005};
  EXPECT_FALSE(overlaps(ball, X_WG, kBlock.points, kSurface));
  EXPECT_FALSE(overlaps(ball, X_WG, kBlock.points, kSurface, 0.0014));
  EXPECT_TRUE(overlaps(ball, X_WG, kBlock.points, kSurface, 0.0021));
}

}  // namespace
}  // namespace palpate::contact::overlap_test
