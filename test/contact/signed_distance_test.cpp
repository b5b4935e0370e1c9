// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/signed_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "test_shapes.h"

namespace palpate::contact::signed_distance_test {
namespace {

using instrument::Box;
using instrument::Capsule;
using instrument::Geometry;
using instrument::Sphere;

/// Independent of the code under test: distance to many points of the surface, sign by membership.
struct Sampled {
  Points surface;
  double spacing;  // no point of the surface is farther than this from a sample
};

Sampled sampleTriangles(const mesh::SurfaceMesh& mesh, int n) {
  Sampled s{Points(3, mesh.triangles.cols() * (n + 1) * (n + 2) / 2), 0.0};
  Eigen::Index at = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
    const Vec3 a = mesh.points.col(mesh.triangles(0, t)), b = mesh.points.col(mesh.triangles(1, t)),
               c = mesh.points.col(mesh.triangles(2, t));
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) s.surface.col(at++) = a + (b - a) * i / n + (c - a) * j / n;
    }
    s.spacing = std::max({s.spacing, (b - a).norm() / n, (c - a).norm() / n, (c - b).norm() / n});
  }
  return s;
}

TEST(SignedDistance, OfHullsAgreesWithDenseSampling) {
  std::mt19937 rng{1};
  for (const auto& [name, geometry] : testShapes()) {
    const auto* hull = std::get_if<instrument::ConvexHull>(&geometry);
    if (hull == nullptr) continue;
    const Sampled sampled = sampleTriangles(hull->surface, 40);
    Points points = randomPoints(&rng, 300, 0.015);
    const Vec3 center = hull->surface.points.rowwise().mean();
    points.leftCols(100) = (0.1 * points.leftCols(100)).colwise() + center;  // some inside
    int inside = 0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Vec3 p = points.col(i);
      const double nearest =
          std::sqrt((sampled.surface.colwise() - p).colwise().squaredNorm().minCoeff());
      const bool is_inside = ((hull->normals.transpose() * p - hull->offsets).array() < 0.0).all();
      inside += is_inside;
      const double value = signedDistanceValue(geometry, p);
      EXPECT_EQ(value, signedDistance(geometry, p).value) << name << " at " << p.transpose();
      EXPECT_EQ(value < 0.0, is_inside) << name;
      EXPECT_LE(std::abs(value), nearest + 1e-15) << name;
      EXPECT_GE(std::abs(value), nearest - sampled.spacing) << name;
    }
    EXPECT_GT(inside, 0) << name;
  }
}

TEST(SignedDistance, OfBoxAndItsHullAgree) {
  std::mt19937 rng{2};
  const Vec3 half(0.002, 0.005, 0.009), center(0.003, -0.001, 0.004);
  const Geometry box = Box{half}, hull = hullOfBox(half, center);
  const Points points = randomPoints(&rng, 5000, 0.02);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec3 p = points.col(i);
    const Distance a = signedDistance(box, p), b = signedDistance(hull, p + center);
    EXPECT_NEAR(a.value, b.value, 1e-15);
    EXPECT_LT((a.normal_G - b.normal_G).norm(), 1e-9);
    EXPECT_LT((a.hessian_G - b.hessian_G).norm(), 1e-6 * (1.0 + a.hessian_G.norm()));
  }
}

TEST(SignedDistance, OfSphereCapsuleAndBoxAtKnownPoints) {
  const Geometry sphere = Sphere{0.5}, capsule = Capsule{0.5, 2.0}, box = Box{Vec3(1.0, 2.0, 3.0)};
  EXPECT_DOUBLE_EQ(signedDistanceValue(sphere, Vec3(3.0, 4.0, 0.0)), 4.5);
  EXPECT_DOUBLE_EQ(signedDistanceValue(sphere, Vec3(0.0, 0.1, 0.0)), -0.4);
  EXPECT_DOUBLE_EQ(signedDistanceValue(capsule, Vec3(3.0, 4.0, -1.9)), 4.5);
  EXPECT_DOUBLE_EQ(signedDistanceValue(capsule, Vec3(3.0, 0.0, 6.0)), 4.5);
  EXPECT_DOUBLE_EQ(signedDistanceValue(capsule, Vec3(0.0, 0.0, -2.25)), -0.25);
  EXPECT_DOUBLE_EQ(signedDistanceValue(box, Vec3(0.25, 0.0, 0.0)), -0.75);
  EXPECT_DOUBLE_EQ(signedDistanceValue(box, Vec3(0.0, -2.5, 0.0)), 0.5);
  EXPECT_DOUBLE_EQ(signedDistanceValue(box, Vec3(4.0, 6.0, 0.0)), 5.0);
  EXPECT_DOUBLE_EQ(signedDistanceValue(box, Vec3(-2.0, 4.0, -5.0)), 3.0);
}

TEST(SignedDistance, InsideAndOutsideMeetAtTheBoundaryOfABox) {
  // Walking out through a face, an edge and a corner, the value grows without a jump.
  const Geometry box = Box{Vec3(1.0, 1.0, 1.0)};
  for (const Vec3& way : {Vec3(1.0, 0.2, 0.1), Vec3(1.0, 1.0, 0.3), Vec3(1.0, 1.0, 1.0)}) {
    double last = signedDistanceValue(box, 0.9 * way);
    for (double s = 0.901; s < 1.1; s += 0.001) {
      const double now = signedDistanceValue(box, s * way);
      EXPECT_GT(now, last);
      EXPECT_LT(now - last, 0.002);
      last = now;
    }
  }
}

/// Whether a step of h about p stays on one smooth piece of the distance.
bool smoothAround(const Geometry& geometry, const Vec3& p, double h) {
  const Distance at = signedDistance(geometry, p);
  for (int i = 0; i < 3; ++i) {
    for (const double step : {-h, h}) {
      const Distance near = signedDistance(geometry, p + step * Vec3::Unit(i));
      const double scale = 1.0 + at.hessian_G.norm();
      if ((near.hessian_G - at.hessian_G).norm() > 0.1 * scale) return false;
      if ((near.normal_G - at.normal_G).norm() > 2.0 * h * scale) return false;
    }
  }
  return true;
}

TEST(SignedDistance, GradientAndHessianAreTheDerivatives) {
  constexpr double h = 1e-7;  // [m]
  std::mt19937 rng{3};
  for (const auto& [name, geometry] : testShapes()) {
    const Points points = randomPoints(&rng, 400, 0.02);
    int checked = 0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Vec3 p = points.col(i);
      if (!smoothAround(geometry, p, 4.0 * h)) continue;
      ++checked;
      const Distance at = signedDistance(geometry, p);
      Vec3 gradient;
      Mat3 hessian;
      for (int k = 0; k < 3; ++k) {
        const Distance plus = signedDistance(geometry, p + h * Vec3::Unit(k));
        const Distance minus = signedDistance(geometry, p - h * Vec3::Unit(k));
        gradient[k] = (plus.value - minus.value) / (2.0 * h);
        hessian.col(k) = (plus.normal_G - minus.normal_G) / (2.0 * h);
      }
      const double scale = 1.0 + at.hessian_G.norm();
      EXPECT_LT((at.normal_G - gradient).norm(), 1e-8 + 1e-12 * scale * scale) << name;
      EXPECT_LT((at.hessian_G - hessian).norm(), 1e-5 * scale) << name << "\n" << at.hessian_G;
    }
    EXPECT_GT(checked, 300) << name;
  }
}

TEST(SignedDistance, NormalIsUnitAndHessianIsSymmetricAndNormalIsInItsKernel) {
  std::mt19937 rng{4};
  for (const auto& [name, geometry] : testShapes()) {
    const Points points = randomPoints(&rng, 500, 0.02);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Distance at = signedDistance(geometry, points.col(i));
      const double scale = 1.0 + at.hessian_G.norm();
      EXPECT_NEAR(at.normal_G.norm(), 1.0, 1e-14) << name;
      EXPECT_LT((at.hessian_G - at.hessian_G.transpose()).norm(), 1e-15 * scale) << name;
      EXPECT_LT((at.hessian_G * at.normal_G).norm(), 1e-13 * scale) << name;
    }
  }
}

TEST(SignedDistance, MovingBackAlongTheNormalReachesTheSurface) {
  std::mt19937 rng{5};
  for (const auto& [name, geometry] : testShapes()) {
    const Points points = randomPoints(&rng, 500, 0.02);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Vec3 p = points.col(i);
      const Distance at = signedDistance(geometry, p);
      EXPECT_NEAR(signedDistanceValue(geometry, p - at.value * at.normal_G), 0.0, 1e-15) << name;
    }
  }
}

TEST(SignedDistance, ValueAloneHasTheSameBits) {
  std::mt19937 rng{6};
  for (const auto& [name, geometry] : testShapes()) {
    const Points points = randomPoints(&rng, 500, 0.02);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const double alone = signedDistanceValue(geometry, points.col(i));
      const double whole = signedDistance(geometry, points.col(i)).value;
      EXPECT_EQ(std::memcmp(&alone, &whole, sizeof(double)), 0) << name;
    }
  }
}

/// Points where the gradient is not defined, and points next to them.
std::vector<Vec3> awkwardPoints(const Geometry& geometry) {
  std::vector<Vec3> points = {Vec3::Zero(), Vec3(0.0, 0.0, 0.01), Vec3(0.0, 0.0, -0.02),
                              Vec3(0.0, 0.0, 0.02)};
  if (const auto* box = std::get_if<Box>(&geometry)) {
    const Vec3 half = box->half_extents;
    points.insert(points.end(),
                  {half, -half, Vec3(half.x(), half.y(), 0.0), Vec3(half.x(), 0.0, 0.0),
                   Vec3(0.0, 0.001, 0.001), Vec3(half - Vec3::Constant(0.001))});
  }
  if (const auto* hull = std::get_if<instrument::ConvexHull>(&geometry)) {
    const auto& [x, triangles] = hull->surface;
    points.push_back(x.rowwise().mean());
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
      const Vec3 a = x.col(triangles(0, t)), b = x.col(triangles(1, t)), c = x.col(triangles(2, t));
      points.insert(points.end(), {a, 0.5 * (a + b), (a + b + c) / 3.0});
    }
  }
  const std::vector<Vec3> exact = points;
  for (const Vec3& p : exact) {
    for (const double tiny : {1e-9, 1e-12, 1e-14, 1e-16, 1e-300}) {
      points.push_back(p + tiny * Vec3(0.3, -0.5, 0.8));
      points.push_back(p - tiny * Vec3(0.3, -0.5, 0.8));
    }
  }
  return points;
}

TEST(SignedDistance, IsFiniteWithAUnitNormalWhereNoGradientIs) {
  for (const auto& [name, geometry] : testShapes()) {
    for (const Vec3& p : awkwardPoints(geometry)) {
      const Distance at = signedDistance(geometry, p);
      ASSERT_TRUE(std::isfinite(at.value) && at.hessian_G.allFinite()) << name << p.transpose();
      EXPECT_NEAR(at.normal_G.norm(), 1.0, 1e-12) << name << p.transpose();
      // A nearest normal: following it, the surface is as far as the value says.
      const double left = signedDistanceValue(geometry, p - at.value * at.normal_G);
      EXPECT_NEAR(left, 0.0, 3e-12) << name << p.transpose();
      EXPECT_EQ(at.normal_G, signedDistance(geometry, p).normal_G);
    }
  }
}

TEST(SignedDistance, FarAwayKeepsItsDigits) {
  for (const auto& [name, geometry] : testShapes()) {
    const Vec3 p = 1e3 * Vec3(0.6, -0.64, 0.48);
    const Distance at = signedDistance(geometry, p);
    EXPECT_NEAR(at.value, p.norm(), 0.05) << name;
    EXPECT_NEAR(at.normal_G.dot(p.normalized()), 1.0, 1e-8) << name;
  }
}

TEST(SignedDistance, OfNotANumberIsNotADistance) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [name, geometry] : testShapes()) {
    for (int k = 0; k < 3; ++k) {
      Vec3 p(0.001, 0.001, 0.001);
      p[k] = nan;
      EXPECT_TRUE(std::isnan(signedDistanceValue(geometry, p))) << name << " axis " << k;
    }
  }
}

}  // namespace
}  // namespace palpate::contact::signed_distance_test
