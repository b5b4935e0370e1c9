// SPDX-License-Identifier: GPL-3.0-or-later
// What is left out as too far to touch would not have: same bits as where each sample is looked at.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "palpate/contact/contact_potential.h"
#include "palpate/contact/signed_distance.h"
#include "palpate/mesh/tet_mesh.h"
#include "test_shapes.h"

namespace palpate::contact::far_samples_test {
namespace {

constexpr double kSpacing = 1e-3;  // of samples [m]

// A block of coarse triangles, touched by samples and by balls of thin tools, and a tool next to a
// larger ball.
class FarSamples : public ::testing::TestWithParam<std::pair<std::string, instrument::Geometry>> {
 protected:
  FarSamples() {
    for (ContactPotential* potential : {&quick, &plain}) {
      potential->addFaceContact(mesh.points, triangles, kSpacing);
    }
    plain.setSkips(true, false);
    tool = Pose(Eigen::Translation3d(0.02, 0.02, 0.025));
  }

  std::vector<Obstacle> obstacles() const {
    const Pose beside(Eigen::Translation3d(tool.translation() + Vec3(0.012, 0.0, 0.004)));
    return {{&GetParam().second, 0, tool, tool}, {&ball, 0, beside, beside}};
  }
  void findCandidates(double reach) {
    for (ContactPotential* potential : {&quick, &plain}) {
      potential->setObstacles(obstacles());
      potential->findCandidates(x, {reach, reach});
    }
  }
  void compare() {
    Points g = Points::Zero(3, x.cols()), h = g;
    ASSERT_EQ(quick.value(x), plain.value(x));
    ASSERT_EQ(quick.addGradient(x, &g), plain.addGradient(x, &h));
    ASSERT_EQ(g, h);
    pushed += g.norm() > 0.0;
    const Points d = randomPoints(&rng, x.cols(), step);
    ASSERT_EQ(quick.maxStep(x, d), plain.maxStep(x, d));
    std::vector<double> allowed, all;
    quick.allowedMotions(x, {0.01, 0.01}, &allowed);
    plain.allowedMotions(x, {0.01, 0.01}, &all);
    ASSERT_EQ(allowed, all);
    std::vector<Touch> touches, every;
    quick.penetrating(x, &touches);
    plain.penetrating(x, &every);
    ASSERT_EQ(touches.size(), every.size());
  }

  std::mt19937 rng{7};
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.04, 0.04, 0.02), Eigen::Vector3i(3, 3, 2));
  Eigen::Matrix3Xi triangles = mesh::boundaryTriangles(mesh.tets);
  Points x = mesh.points;
  ContactPotential quick{sampleSurface(x, triangles, kSpacing), makeResponse({"penalty"})};
  ContactPotential plain{sampleSurface(x, triangles, kSpacing), makeResponse({"penalty"})};
  instrument::Geometry ball = instrument::Sphere{0.004};
  Pose tool;
  double step = 0.0;  // how far a node goes at once [m]
  int pushed = 0;
};

std::vector<std::pair<std::string, instrument::Geometry>> tools() {
  auto all = testShapes();
  all.emplace_back("needle", instrument::Cylinder{2.5e-4, 0.015});
  all.emplace_back("blade", instrument::Box{Vec3(1e-4, 0.005, 0.012)});
  return all;
}
INSTANTIATE_TEST_SUITE_P(Tools, FarSamples, ::testing::ValuesIn(tools()), [](const auto& of) {
  std::string name = of.param.first;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
});

TEST_P(FarSamples, WouldNotHaveTouched) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int round = 0; round < 6; ++round) {
    x = mesh.points;
    findCandidates(round % 3 == 0 ? 0.002 : round % 3 == 1 ? 0.01 : 0.1);
    for (int k = 0; k < 25; ++k) {
      step = std::pow(10.0, -6.0 + 3.5 * u(rng));
      x += randomPoints(&rng, x.cols(), step);
      if (k % 3 == 0) tool.translation() += step * Vec3(u(rng) - 0.5, u(rng) - 0.5, u(rng) - 0.5);
      if (k % 8 == 0) {
        tool.linear() = randomPose(&rng, 0.0).linear();
        tool.translation() = Vec3(0.02, 0.02, 0.018 + 0.01 * u(rng));
      }
      for (ContactPotential* potential : {&quick, &plain}) potential->setObstacles(obstacles());
      compare();
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(pushed, 25);
}

// Candidates are all samples within reach, and no others.
TEST_P(FarSamples, AreNoCandidates) {
  ContactPotential samples(sampleSurface(x, triangles, kSpacing), makeResponse({"penalty"}));
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int found = 0, left_out = 0;
  for (int k = 0; k < 60; ++k) {
    x = mesh.points + randomPoints(&rng, x.cols(), 2e-3);
    tool.linear() = randomPose(&rng, 0.0).linear();
    tool.translation() = Vec3(0.02, 0.02, 0.02) + 0.015 * Vec3(u(rng), u(rng), u(rng));
    const std::vector<double> reach{std::pow(10.0, -3.0 + 0.5 * u(rng)), 1e-3};
    samples.setObstacles(obstacles());
    samples.findCandidates(x, reach);
    int near = 0;
    for (std::size_t b = 0; b < 2; ++b) {
      const Obstacle obstacle = obstacles()[b];
      const Pose X_GW = obstacle.X_WG_end.inverse();
      for (const SurfaceSample& sample : samples.samples()) {
        near += signedDistanceValue(*obstacle.geometry, X_GW * sample.position(x)) <= reach[b];
      }
    }
    ASSERT_EQ(samples.numCandidates(), near) << k;
    found += near;
    left_out += samples.numDistant();
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(left_out, found);
}

// The tool stands; what was far from it is so no more.
TEST_P(FarSamples, AreAskedAgainWhereTheyCameNear) {
  tool.translation() += Vec3(0.0, 0.0, 0.03);
  findCandidates(0.1);
  int pressed = 0;
  for (int k = 0; k < 45; ++k) {
    ASSERT_EQ(quick.value(x), plain.value(x)) << k;
    pressed += quick.value(x) > 0.0;
    x.row(2).array() += 1e-3;
  }
  EXPECT_GT(pressed, 5);
}

}  // namespace
}  // namespace palpate::contact::far_samples_test
