// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "palpate/contact/signed_distance.h"
#include "test_shapes.h"

namespace palpate::contact::cylinder_distance_test {
namespace {

using instrument::Cylinder;
using instrument::Geometry;

// Rings and discs so dense that no point of the surface is farther than `spacing` from one.
Points sampleCylinder(const Cylinder& cylinder, double spacing) {
  constexpr double kTurn = 2.0 * EIGEN_PI;
  const int around = static_cast<int>(std::ceil(kTurn * cylinder.radius / spacing));
  const int along = static_cast<int>(std::ceil(2.0 * cylinder.half_length / spacing));
  const int across = static_cast<int>(std::ceil(cylinder.radius / spacing));
  std::vector<Vec3> points;
  for (int a = 0; a < around; ++a) {
    const double angle = kTurn * a / around;
    const Vec3 radial(std::cos(angle), std::sin(angle), 0.0);
    for (int i = 0; i <= along; ++i) {
      const double z = cylinder.half_length * (2.0 * i / along - 1.0);
      points.emplace_back(cylinder.radius * radial + z * Vec3::UnitZ());
    }
    for (int i = 0; i < across; ++i) {
      for (const double z : {-cylinder.half_length, cylinder.half_length}) {
        points.emplace_back(cylinder.radius * i / across * radial + z * Vec3::UnitZ());
      }
    }
  }
  Points all(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = points[i];
  return all;
}

TEST(CylinderDistance, AgreesWithDenseSampling) {
  constexpr double kSpacing = 1e-4;
  std::mt19937 rng{7};
  for (const Cylinder& cylinder : {Cylinder{0.004, 0.008}, Cylinder{0.008, 0.002}}) {
    const Points surface = sampleCylinder(cylinder, kSpacing);
    Points points = randomPoints(&rng, 300, 0.012);
    points.leftCols(100) *= 0.5;  // some inside
    int inside = 0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Vec3 p = points.col(i);
      const double nearest = std::sqrt((surface.colwise() - p).colwise().squaredNorm().minCoeff());
      const bool is_inside =
          p.head<2>().norm() < cylinder.radius && std::abs(p.z()) < cylinder.half_length;
      inside += is_inside;
      const double value = signedDistanceValue(Geometry(cylinder), p);
      EXPECT_EQ(value < 0.0, is_inside);
      EXPECT_LE(std::abs(value), nearest + 1e-15);
      EXPECT_GE(std::abs(value), nearest - kSpacing);
    }
    EXPECT_GT(inside, 10);
  }
}

TEST(CylinderDistance, IsKnownAtSomePoints) {
  const Geometry cylinder = Cylinder{1.0, 2.0};
  EXPECT_DOUBLE_EQ(signedDistanceValue(cylinder, Vec3(3.0, 4.0, 1.0)), 4.0);
  EXPECT_DOUBLE_EQ(signedDistanceValue(cylinder, Vec3(0.6, 0.0, -2.5)), 0.5);
  EXPECT_DOUBLE_EQ(signedDistanceValue(cylinder, Vec3(0.0, 4.0, -6.0)), 5.0);
  EXPECT_DOUBLE_EQ(signedDistanceValue(cylinder, Vec3(0.0, 0.1, 1.5)), -0.5);
}

}  // namespace
}  // namespace palpate::contact::cylinder_distance_test
