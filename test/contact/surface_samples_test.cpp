// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/surface_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpate/mesh/tet_mesh.h"
#include "support/random.h"

namespace palpate::contact::surface_samples_test {
namespace {

const mesh::TetMesh kBox = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(2));
const Eigen::Matrix3Xi kSurface = mesh::boundaryTriangles(kBox.tets);

double totalArea(const std::vector<SurfaceSample>& samples) {
  double sum = 0.0;
  for (const SurfaceSample& s : samples) sum += s.area;
  return sum;
}

// Of the surface of a cube of 100 mm.
void expectNoGap(const mesh::TetMesh& box, const std::vector<SurfaceSample>& samples,
                 double spacing) {
  test::Random random;
  for (int trial = 0; trial < 500; ++trial) {
    Vec3 p = Vec3(random.uniform(0, 0.1), random.uniform(0, 0.1), random.uniform(0, 0.1));
    p[trial % 3] = trial % 2 ? 0.1 : 0.0;
    double nearest = 1.0;
    for (const SurfaceSample& s : samples) {
      nearest = std::min(nearest, (s.position(box.points) - p).norm());
    }
    EXPECT_LE(nearest, spacing);
  }
}

TEST(SurfaceSamples, AreTheNodesWhereNoSpacingIsAsked) {
  const auto samples = sampleSurface(kBox.points, kSurface, 0.0);
  EXPECT_EQ(samples.size(), 26u);  // 27 nodes, one inside
  EXPECT_NEAR(totalArea(samples), 0.06, 1e-15);
}

TEST(SurfaceSamples, LieWithinTheSpacingAndOnlyOnce) {
  constexpr double kSpacing = 0.02;
  const auto samples = sampleSurface(kBox.points, kSurface, kSpacing);
  EXPECT_NEAR(totalArea(samples), 0.06, 1e-15);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_NEAR(samples[i].weights.sum(), 1.0, 1e-15);
    double nearest = 1.0;
    for (std::size_t j = 0; j < samples.size(); ++j) {
      if (i == j) continue;
      nearest = std::min(
          nearest, (samples[i].position(kBox.points) - samples[j].position(kBox.points)).norm());
    }
    EXPECT_GT(nearest, 1e-6);
    EXPECT_LE(nearest, kSpacing);
  }
}

// A fan of triangles with edges of 1 to 32 mm: samples are as dense everywhere, not as many.
TEST(SurfaceSamples, AreFewerInSmallTrianglesOfAGradedSurface) {
  Points X(3, 14);
  Eigen::Matrix3Xi triangles(3, 12);
  for (int k = 0; k < 7; ++k) {
    const double x = k < 6 ? std::pow(2.0, k) * 1e-3 : 0.064;
    X.col(2 * k) = Vec3(x, 0.0, 0.0);
    X.col(2 * k + 1) = Vec3(x, x, 0.0);
    if (k == 6) break;
    triangles.col(2 * k) = Eigen::Vector3i(2 * k, 2 * k + 2, 2 * k + 1);
    triangles.col(2 * k + 1) = Eigen::Vector3i(2 * k + 1, 2 * k + 2, 2 * k + 3);
  }
  const double area = 0.5 * (0.064 * 0.064 - 1e-6), spacing = 0.002;
  const auto samples = sampleSurface(X, triangles, spacing);
  EXPECT_NEAR(totalArea(samples), area, 1e-15);
  // Small triangles have three parts an edge, and so a sample in their middle.
  EXPECT_TRUE(std::any_of(samples.begin(), samples.end(), [&](const SurfaceSample& s) {
    return s.nodes == triangles.col(0) && s.weights.isApprox(Vec3::Constant(1.0 / 3.0));
  }));
  EXPECT_LT(samples.size() * spacing * spacing, 3.0 * area);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      ASSERT_GT((samples[i].position(X) - samples[j].position(X)).norm(), 1e-6);
    }
  }
  test::Random random;
  for (int trial = 0; trial < 500; ++trial) {
    const double x = random.uniform(0.001, 0.064);
    const Vec3 p(x, random.uniform(0.0, x), 0.0);
    double nearest = 1.0;
    for (const SurfaceSample& s : samples) nearest = std::min(nearest, (s.position(X) - p).norm());
    ASSERT_LE(nearest, spacing) << p.transpose();
  }
}

// Whatever point of the surface a tool comes to, a sample is near.
TEST(SurfaceSamples, LeaveNoGap) {
  constexpr double kSpacing = 0.015;
  const auto samples = sampleSurface(kBox.points, kSurface, kSpacing);
  expectNoGap(kBox, samples, kSpacing);
}

// However small the triangles are against the spacing: a tool feels faces, not nodes alone, which
// it could push aside.
TEST(SurfaceSamples, LieBetweenAnyTwoNodes) {
  const auto samples = sampleSurface(kBox.points, kSurface, 10.0);
  const auto edges = 3 * kSurface.cols() / 2;
  EXPECT_EQ(samples.size(), static_cast<std::size_t>(26 + 2 * edges + kSurface.cols()));
}

// Triangles of different sizes get as many samples as each needs, and their area goes to them so
// that a uniform pressure has the same resultant and moment as on the triangles.
TEST(SurfaceSamples, AreDenseOnlyWhereTrianglesAreLarge) {
  mesh::TetMesh box = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(8));
  // Crowded towards one edge: triangles from 1 to 40 mm.
  box.points = (box.points.array() / 0.1).square() * 0.1;
  const Eigen::Matrix3Xi surface = mesh::boundaryTriangles(box.tets);
  constexpr double kSpacing = 0.005;
  const auto samples = sampleSurface(box.points, surface, kSpacing);
  Vec3 moment = Vec3::Zero(), expected = Vec3::Zero();
  double area = 0.0;
  for (Eigen::Index t = 0; t < surface.cols(); ++t) {
    const Vec3 a = box.points.col(surface(0, t)), b = box.points.col(surface(1, t)),
               c = box.points.col(surface(2, t));
    const double size = 0.5 * (b - a).cross(c - a).norm();
    area += size;
    expected += size * (a + b + c) / 3.0;
  }
  for (const SurfaceSample& s : samples) {
    EXPECT_GT(s.area, 0.0);
    moment += s.area * s.position(box.points);
  }
  EXPECT_NEAR(totalArea(samples), area, 1e-14);
  EXPECT_LT((moment - expected).norm(), 1e-15);
  // As many as the area and the spacing need, not as the smallest triangle would have.
  EXPECT_LT(static_cast<double>(samples.size()), 4.0 * area / (kSpacing * kSpacing));
  expectNoGap(box, samples, kSpacing);
}

}  // namespace
}  // namespace palpate::contact::surface_samples_test
