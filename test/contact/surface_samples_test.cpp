// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/surface_samples.h"

#include <gtest/gtest.h>

#include "palpate/mesh/tet_mesh.h"
#include "support/random.h"

namespace palpate::contact {
namespace {

const mesh::TetMesh kBox = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(2));
const Eigen::Matrix3Xi kSurface = mesh::boundaryTriangles(kBox.tets);

double totalArea(const std::vector<SurfaceSample>& samples) {
  double sum = 0.0;
  for (const SurfaceSample& s : samples) sum += s.area;
  return sum;
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

// Whatever point of the surface a tool comes to, a sample is near.
TEST(SurfaceSamples, LeaveNoGap) {
  constexpr double kSpacing = 0.015;
  const auto samples = sampleSurface(kBox.points, kSurface, kSpacing);
  test::Random random;
  for (int trial = 0; trial < 500; ++trial) {
    Vec3 p = Vec3(random.uniform(0, 0.1), random.uniform(0, 0.1), random.uniform(0, 0.1));
    p[trial % 3] = trial % 2 ? 0.1 : 0.0;
    double nearest = 1.0;
    for (const SurfaceSample& s : samples) {
      nearest = std::min(nearest, (s.position(kBox.points) - p).norm());
    }
    EXPECT_LE(nearest, kSpacing);
  }
}

}  // namespace
}  // namespace palpate::contact
