// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/size_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/surfaces.h"
#include "palpate/mesh/size_estimate.h"
#include "support/random.h"

namespace palpate::mesh::size_field_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

RefinementZone placeAt(decltype(RefinementZone::where) where, double finest = 0.002,
                       double growth = 0.3, double radius = 0.0) {
  RefinementZone place;
  place.where = std::move(where);
  place.finest = finest;
  place.growth = growth;
  place.radius = radius;
  return place;
}

// A box of 0.1 m with a corner at the origin, and all kinds of places.
SizeField manyPlaces() {
  SizeField field;
  field.coarsest = 0.015;
  field.near = {placeAt(Polyline{{Vec3(0.05, 0.05, 0.1)}}, 0.001, 0.3, 0.008),
                placeAt(Polyline{{Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0.1, 0.1, 0)}}, 0.003, 0.5),
                placeAt(BoxRegion{Vec3(0.02, 0.02, 0.02), Vec3(0.03, 0.04, 0.05)}, 0.002, 1.0),
                placeAt(SphereRegion{Vec3(0.08, 0.08, 0.08), 0.01}, 0.002, 0.2, 0.005),
                placeAt(PlaneRegion{0, 0.1, -1.0}, 0.004, 0.3),
                placeAt(OwnSurface{}, 0.005, 0.1, 0.001)};
  return field;
}

TEST(SizeField, DistancesFromLines) {
  const Polyline corner{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 2, 0)}};
  EXPECT_DOUBLE_EQ(distanceTo(corner, Vec3(0.5, 0, 3)), 3.0);      // above the first line
  EXPECT_DOUBLE_EQ(distanceTo(corner, Vec3(-3, 0, 4)), 5.0);       // before its beginning
  EXPECT_DOUBLE_EQ(distanceTo(corner, Vec3(1, 5, 4)), 5.0);        // behind the end
  EXPECT_DOUBLE_EQ(distanceTo(corner, Vec3(1.25, 1.5, 0)), 0.25);  // next to the second
  EXPECT_DOUBLE_EQ(distanceTo(Polyline{{Vec3(1, 2, 3)}}, Vec3(1, 5, 7)), 5.0);
  EXPECT_DOUBLE_EQ(distanceTo(Polyline{{Vec3::Zero(), Vec3::Zero()}}, Vec3(0, 3, 4)), 5.0);
}

TEST(SizeField, DistancesFromRegions) {
  const Region box = BoxRegion{Vec3(0, 0, 0), Vec3(1, 2, 3)};
  EXPECT_EQ(distanceTo(box, Vec3(0.5, 1, 3)), 0.0);
  EXPECT_DOUBLE_EQ(distanceTo(box, Vec3(0.5, 1, 3.5)), 0.5);  // over a face
  EXPECT_DOUBLE_EQ(distanceTo(box, Vec3(-3, -4, 1)), 5.0);    // over an edge
  EXPECT_DOUBLE_EQ(distanceTo(box, Vec3(3, 4, -1)), 3.0);     // over a corner: 2, 2, 1
  const Region ball = SphereRegion{Vec3(1, 1, 1), 2.0};
  EXPECT_EQ(distanceTo(ball, Vec3(1, 2, 1)), 0.0);
  EXPECT_DOUBLE_EQ(distanceTo(ball, Vec3(1, 1, 6)), 3.0);
  EXPECT_DOUBLE_EQ(distanceTo(PlaneRegion{1, 2.0, -1.0}, Vec3(9, -1, 9)), 3.0);
  EXPECT_DOUBLE_EQ(distanceTo(PlaneRegion{1, 2.0, 0.5}, Vec3(9, -1, 9)), 2.5);
  EXPECT_EQ(distanceTo(PlaneRegion{1, 2.0, 0.5}, Vec3(9, 1.6, 9)), 0.0);
}

TEST(SizeField, DistanceFromASurfaceAndItsInside) {
  const SurfaceDistance surface(boxSurface(0.1, 3));
  EXPECT_NEAR(surface(Vec3(0.05, 0.05, 0.02)), 0.02, 1e-15);
  EXPECT_NEAR(surface(Vec3(0.05, 0.05, -0.02)), 0.02, 1e-15);
  EXPECT_NEAR(surface(Vec3(0.13, 0.14, 0.05)), 0.05, 1e-15);
  test::Random random;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 p = Vec3::Constant(0.05) + random.vector(0.1);
    const bool inside = (p.array() > 0.0).all() && (p.array() < 0.1).all();
    ASSERT_EQ(surface.contains(p), inside) << p.transpose();
  }
}

TEST(SizeField, GrowsFromARadiusOnUpToTheCoarsest) {
  SizeField field;
  field.coarsest = 0.015;
  field.near = {placeAt(Polyline{{Vec3::Zero()}}, 0.002, 0.25, 0.008)};
  const BodySizes sizes(field, SurfaceDistance(boxSurface(0.1, 1)));
  EXPECT_DOUBLE_EQ(sizes.at(Vec3::Zero()), 0.002);
  EXPECT_DOUBLE_EQ(sizes.at(Vec3(0, 0.008, 0)), 0.002);
  EXPECT_DOUBLE_EQ(sizes.at(Vec3(0, 0, 0.028)), 0.007);
  EXPECT_DOUBLE_EQ(sizes.at(Vec3(0, 0, 0.060)), 0.015);
  EXPECT_DOUBLE_EQ(sizes.at(Vec3(0, 0, 0.070)), 0.015);
  EXPECT_DOUBLE_EQ(sizes.ofZone(0, Vec3(0, 0, 0.108)), 0.027);
  EXPECT_DOUBLE_EQ(sizes.at(Vec3(0, 0, 0.028), -0.01), 0.0045);
  EXPECT_DOUBLE_EQ(sizes.at(Vec3(0, 0, 0.028), 0.01), 0.0095);
}

TEST(SizeField, TheSmallestHoldsAndChangesNoFasterThanItGrows) {
  const SizeField field = manyPlaces();
  const BodySizes sizes(field, SurfaceDistance(boxSurface(0.1, 1)));
  test::Random random;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 p = Vec3::Constant(0.05) + random.vector(0.1);
    double least = field.coarsest;
    for (std::size_t i = 0; i < field.near.size(); ++i) least = std::min(least, sizes.ofZone(i, p));
    ASSERT_EQ(sizes.at(p), least);
    const Vec3 q = p + random.vector(std::pow(10.0, -1.0 - k % 5));
    ASSERT_LE(std::abs(sizes.at(p) - sizes.at(q)), 1.0 * (p - q).norm() * (1.0 + 1e-12));
    const double shift = random.uniform(0.0, 0.003);
    for (std::size_t i = 0; i < field.near.size(); ++i) {
      ASSERT_LE(std::abs(sizes.ofZone(i, p) - sizes.ofZone(i, q)),
                field.near[i].growth * (p - q).norm() * (1.0 + 1e-12) + 1e-15);
    }
    ASSERT_GE(sizes.at(p, shift), sizes.at(p));
    ASSERT_LE(sizes.at(p, -shift), sizes.at(p));
  }
}

TEST(SizeEstimate, OfEqualEdgesIsTheVolumes) {
  const SurfaceMesh box = boxSurface(0.1, 2);
  SizeField field;
  field.coarsest = 0.01;
  const SizeEstimate estimate = estimateTets(box, field, 1e9);
  EXPECT_TRUE(estimate.complete);
  EXPECT_NEAR(estimate.tets, estimateTets(1e-3, 0.01), 0.02 * estimate.tets);
}

// A ball of radius R in the middle, growth g from there on: 4 pi times the integral of r^2 / h^3,
// h = f + g (r - R), by the trapezoidal rule as far as the ball of 0.05 m goes; beyond it one size.
TEST(SizeEstimate, OfAPlaceIsTheIntegral) {
  SizeField field;
  field.coarsest = 0.014;
  field.near = {placeAt(Polyline{{Vec3::Constant(0.05)}}, 0.002, 0.3, 0.01),
                placeAt(Polyline{{Vec3::Constant(0.5)}}, 0.002, 0.3, 0.01)};
  const int n = 4000;
  double sum = 0.0;
  for (int k = 0; k <= n; ++k) {
    const double r = 0.05 * k / n, h = 0.002 + 0.3 * std::max(0.0, r - 0.01);
    sum += (k == 0 || k == n ? 0.5 : 1.0) * (0.05 / n) * 4.0 * kPi * r * r / (0.095 * h * h * h);
  }
  const double ball = 4.0 / 3.0 * kPi * std::pow(0.05, 3);
  const double exact = sum + estimateTets(1e-3 - ball, 0.014);
  const SizeEstimate estimate = estimateTets(boxSurface(0.1, 2), field, 1e9);
  EXPECT_NEAR(estimate.tets, exact, 0.04 * exact);
  EXPECT_NEAR(estimate.of_zone[0], sum, 0.04 * exact);
  EXPECT_EQ(estimate.of_zone[1], 0.0);
  EXPECT_TRUE(estimate.felt[0]);
  EXPECT_FALSE(estimate.felt[1]);
  EXPECT_EQ(estimateTets(boxSurface(0.1, 2), field, 1e9).tets, estimate.tets);
}

TEST(SizeEstimate, StopsWhereThereAreTooMany) {
  SizeField field;
  field.coarsest = 0.014;
  field.near = {placeAt(OwnSurface{}, 1e-5, 1.0)};
  const SizeEstimate estimate = estimateTets(boxSurface(0.1, 2), field, 1e4);
  EXPECT_FALSE(estimate.complete);
  EXPECT_GT(estimate.tets, 1e4);
  EXPECT_GT(estimate.of_zone[0], 0.8 * estimate.tets);
}

}  // namespace
}  // namespace palpate::mesh::size_field_test
