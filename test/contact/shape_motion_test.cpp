// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpate/contact/signed_distance.h"
#include "test_shapes.h"

namespace palpate::contact::shape_motion_test {
namespace {

/// A point of the shape (inside or on it), by rejection.
Vec3 randomPointOf(const instrument::Geometry& geometry, std::mt19937* rng) {
  const double radius = boundingRadius(geometry);
  for (;;) {
    const Vec3 p = randomPoints(rng, 1, radius).col(0);
    const Distance at = signedDistance(geometry, p);
    if (at.value <= 0.0) return p - 0.999 * at.value * at.normal_G;  // next to the surface
  }
}

TEST(ShapeMotion, BoundingBallHoldsTheShapeAndTouchesIt) {
  std::mt19937 rng{11};
  for (const auto& [name, geometry] : testShapes()) {
    const double radius = boundingRadius(geometry);
    double farthest = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 direction = randomPoints(&rng, 1, 1.0).col(0).normalized();
      EXPECT_GT(signedDistanceValue(geometry, 1.0001 * radius * direction), 0.0) << name;
      if (signedDistanceValue(geometry, 0.9 * radius * direction) < 0.0) farthest = 0.9 * radius;
    }
    EXPECT_GT(farthest, 0.0) << name << ": the ball is much larger than the shape";
  }
}

TEST(ShapeMotion, InscribedBallFits) {
  for (const auto& [name, geometry] : testShapes()) {
    const double radius = inscribedRadius(geometry);
    EXPECT_GT(radius, 0.0) << name;
    const auto* hull = std::get_if<instrument::ConvexHull>(&geometry);
    const Vec3 center =
        hull == nullptr ? Vec3(0.0, 0.0, 0.0) : Vec3(hull->surface.points.rowwise().mean());
    EXPECT_LE(signedDistanceValue(geometry, center), -radius + 1e-15) << name;
  }
  EXPECT_DOUBLE_EQ(inscribedRadius(instrument::Box{Vec3(3.0, 1.0, 2.0)}), 1.0);
  EXPECT_NEAR(inscribedRadius(hullOfBox(Vec3(3.0, 1.0, 2.0), Vec3(9.0, 9.0, 9.0))), 1.0, 1e-14);
}

TEST(ShapeMotion, SweepLengthBoundsTheWayOfEveryPoint) {
  std::mt19937 rng{12};
  for (const auto& [name, geometry] : testShapes()) {
    for (int trial = 0; trial < 50; ++trial) {
      const Pose begin = randomPose(&rng, 0.01), end = randomPose(&rng, 0.01);
      const double bound = sweepLength(geometry, begin, end);
      for (int i = 0; i < 20; ++i) {
        const Vec3 p = randomPointOf(geometry, &rng);
        double way = 0.0;
        Vec3 last = begin * p;
        for (int s = 1; s <= 32; ++s) {
          const Vec3 now = interpolate(begin, end, s / 32.0) * p;
          way += (now - last).norm();
          last = now;
        }
        EXPECT_LE(way, bound * (1.0 + 1e-12)) << name;
      }
    }
  }
}

TEST(ShapeMotion, SweepLengthIsTightForPureTranslationAndZeroAtRest) {
  std::mt19937 rng{13};
  for (const auto& [name, geometry] : testShapes()) {
    const Pose begin = randomPose(&rng, 0.01);
    Pose end = begin;
    EXPECT_LT(sweepLength(geometry, begin, begin), 1e-9) << name;
    end.translation() += Vec3(0.003, 0.0, -0.004);
    EXPECT_NEAR(sweepLength(geometry, begin, end), 0.005, 1e-9) << name;
  }
}

TEST(ShapeMotion, InterpolationHitsItsEndsExactly) {
  std::mt19937 rng{14};
  for (int trial = 0; trial < 100; ++trial) {
    const Pose begin = randomPose(&rng, 1.0), end = randomPose(&rng, 1.0);
    EXPECT_EQ(interpolate(begin, end, 0.0).matrix(), begin.matrix());
    EXPECT_EQ(interpolate(begin, end, 1.0).matrix(), end.matrix());
  }
}

TEST(ShapeMotion, InterpolationIsEvenAndStaysARotation) {
  std::mt19937 rng{15};
  for (int trial = 0; trial < 100; ++trial) {
    const Pose begin = randomPose(&rng, 1.0), end = randomPose(&rng, 1.0);
    const Eigen::AngleAxisd whole(Mat3(begin.linear().transpose() * end.linear()));
    for (const double s : {1e-9, 0.25, 0.5, 0.99}) {
      const Pose X = interpolate(begin, end, s);
      EXPECT_LT((X.linear() * X.linear().transpose() - Mat3::Identity()).norm(), 1e-14);
      EXPECT_LT(
          (X.translation() - begin.translation() - s * (end.translation() - begin.translation()))
              .norm(),
          1e-15);
      const Mat3 expected =
          begin.linear() * Eigen::AngleAxisd(s * whole.angle(), whole.axis()).toRotationMatrix();
      EXPECT_LT((X.linear() - expected).norm(), 1e-7);
    }
  }
}

}  // namespace
}  // namespace palpate::contact::shape_motion_test
