// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "palpate/contact/overlap.h"
#include "palpate/contact/signed_distance.h"
#include "palpate/mesh/tet_mesh.h"
#include "sampled_surfaces.h"
#include "test_shapes.h"

namespace palpate::contact::sampled_distance_test {
namespace {

using instrument::Geometry;

TEST(SampledDistance, NormalTimesSteepnessIsTheGradientAndHessianItsDerivative) {
  std::mt19937 rng{1};
  constexpr double h = 1e-8;
  for (const mesh::SurfaceMesh& surface : {test::uSurface(), test::hookSurface()}) {
    const Geometry geometry = sampled(surface);
    const Vec3 middle = surface.points.rowwise().mean();
    int flat = 0;
    for (int n = 0; n < 1000; ++n) {
      const Vec3 p = middle + randomPoints(&rng, 1, 0.012).col(0);
      const Distance at = signedDistance(geometry, p);
      EXPECT_EQ(at.value, signedDistanceValue(geometry, p));
      EXPECT_NEAR(at.normal_G.norm(), 1.0, 1e-14);
      EXPECT_LT((at.hessian_G - at.hessian_G.transpose()).norm(), 1e-12 * at.hessian_G.norm());
      flat += at.steepness < 0.9;
      for (int k = 0; k < 3; ++k) {
        const Distance plus = signedDistance(geometry, p + h * Vec3::Unit(k));
        const Distance minus = signedDistance(geometry, p - h * Vec3::Unit(k));
        EXPECT_NEAR(at.steepness * at.normal_G[k], (plus.value - minus.value) / (2.0 * h), 1e-6);
        const Vec3 change = plus.steepness * plus.normal_G - minus.steepness * minus.normal_G;
        // Over 1 / cell, some 3000 / m.
        EXPECT_LT((at.hessian_G.col(k) - change / (2.0 * h)).norm(), 1.0);
      }
    }
    EXPECT_GT(flat, 20);
  }
}

// Torus: closed forms of normal and of both curvatures. Away from its middle line and its axis.
TEST(SampledDistance, OfARingHasItsNormalAndCurvature) {
  constexpr double kRing = 0.010, kWire = 0.003;
  const Geometry ring = sampled(test::ringSurface(kRing, kWire, 384, 192));
  std::mt19937 rng{2};
  std::uniform_real_distribution<double> angle(0.0, 2.0 * EIGEN_PI), off(-0.5e-3, 0.5e-3);
  double worst = 0.0;
  for (int n = 0; n < 2000; ++n) {
    const double a = angle(rng), b = angle(rng), rho = kWire + off(rng);
    const Vec3 radial(std::cos(a), std::sin(a), 0.0);
    const Vec3 normal = std::cos(b) * radial + std::sin(b) * Vec3::UnitZ();
    const Vec3 p = kRing * radial + rho * normal;
    const Distance at = signedDistance(ring, p);
    EXPECT_NEAR(at.value, rho - kWire, 2e-5);
    EXPECT_NEAR(at.steepness, 1.0, 0.02);
    EXPECT_LT((at.normal_G - normal).norm(), 0.02);
    const double mean = 1.0 / rho + std::cos(b) / (kRing + rho * std::cos(b));
    worst = std::max(worst, std::abs(at.hessian_G.trace() - mean) * kWire);
  }
  EXPECT_LT(worst, 0.25);  // of the wire's curvature: facets bend by 1.9 degrees each 0.1 mm
  std::cout << "worst mean curvature off by " << worst << " of the wire's\n";
}

TEST(SampledDistance, ShapeIsBoundedAndHasAnInside) {
  const Geometry u = sampled(test::uSurface());
  EXPECT_DOUBLE_EQ(boundingRadius(u), Vec3(0.015, 0.005, 0.015).norm());
  EXPECT_GT(inscribedRadius(u), 0.0021);
  EXPECT_LE(inscribedRadius(u), 0.0025 + 1e-6);  // half as thick as it is
  EXPECT_GT(distanceError(u), 0.0);
  EXPECT_EQ(distanceError(instrument::Sphere{1.0}), 0.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(signedDistanceValue(u, Vec3(0.0, nan, 0.0))));
  EXPECT_TRUE(std::isnan(signedDistance(u, Vec3(0.0, nan, 0.0)).value));
}

TEST(SampledDistance, TissueInANotchIsNotInTheShape) {
  const mesh::TetMesh block = mesh::boxMesh(Vec3::Constant(0.003), Eigen::Vector3i::Ones());
  const Eigen::Matrix3Xi triangles = mesh::boundaryTriangles(block.tets);
  const Geometry u = sampled(test::uSurface()), hull = hullOf(test::uSurface().points);
  const auto at = [&](const Vec3& low) { return Points(block.points.colwise() + low); };
  const Points in_notch = at(Vec3(0.006, 0.001, 0.007)), in_wall = at(Vec3(0.003, 0.001, 0.007)),
               swallowed = at(Vec3(0.001, 0.001, 0.001)), beside = at(Vec3(0.02, 0.0, 0.0));
  EXPECT_FALSE(overlaps(u, Pose::Identity(), in_notch, triangles));
  EXPECT_TRUE(overlaps(hull, Pose::Identity(), in_notch, triangles));
  EXPECT_TRUE(overlaps(u, Pose::Identity(), in_wall, triangles));
  EXPECT_TRUE(overlaps(u, Pose::Identity(), swallowed, triangles));
  EXPECT_FALSE(overlaps(u, Pose::Identity(), beside, triangles));
  EXPECT_TRUE(overlaps(u, Pose::Identity(), in_notch, triangles, 0.0015));
}

}  // namespace
}  // namespace palpate::contact::sampled_distance_test
