// SPDX-License-Identifier: GPL-3.0-or-later
// The anatomy meets samples of its own: as many as it needs, and what they feel is what they would
// feel alone.
#include <gtest/gtest.h>

#include <vector>

#include "palpate/contact/contact_potential.h"
#include "palpate/contact/signed_distance.h"
#include "palpate/mesh/tet_mesh.h"
#include "test_shapes.h"

namespace palpate::contact::anatomy_samples_test {
namespace {

constexpr double kFine = 1e-3, kCoarse = 6e-3;  // between samples [m]

// A block, a ball in its top, a plate under it.
class AnatomySamples : public ::testing::Test {
 protected:
  AnatomySamples() { both.addAnatomySamples(x, triangles, kCoarse); }

  std::vector<Obstacle> obstacles() const { return {tool(), bone()}; }
  Obstacle tool() const {
    const Pose above(Eigen::Translation3d(0.02, 0.021, 0.042));
    return {&ball, 0, above, above};
  }
  Obstacle bone() const {
    const Pose below(Eigen::Translation3d(0.02, 0.02, -0.0095));
    return {&plate, Owner::anatomy(0), below, below, 1};
  }
  static ContactPotential of(const Points& X, const Eigen::Matrix3Xi& triangles, double spacing) {
    return {sampleSurface(X, triangles, spacing), makeResponse({"penalty"})};
  }

  const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.04, 0.04, 0.04), Eigen::Vector3i(2, 2, 2));
  const Eigen::Matrix3Xi triangles = mesh::boundaryTriangles(mesh.tets);
  Points x = mesh.points;
  ContactPotential both = of(x, triangles, kFine);
  const instrument::Geometry ball = instrument::Sphere{0.004};
  const instrument::Geometry plate = instrument::Box{Vec3(0.05, 0.05, 0.01)};
  std::mt19937 rng{3};
};

TEST_F(AnatomySamples, AreFeltAsIfAlone) {
  ContactPotential fine = of(x, triangles, kFine), coarse = of(x, triangles, kCoarse);
  for (int k = 0; k < 20; ++k) {
    x = mesh.points + randomPoints(&rng, x.cols(), 5e-4);
    both.setObstacles(obstacles());
    both.findCandidates(x, {0.002, 0.002});
    fine.setObstacles({tool()});
    fine.findCandidates(x, {0.002});
    coarse.setObstacles({bone()});
    coarse.findCandidates(x, {0.002});
    ASSERT_GT(fine.numCandidates(), 0);
    ASSERT_GT(coarse.numCandidates(), 0);
    ASSERT_EQ(both.numCandidates(), fine.numCandidates() + coarse.numCandidates());
    ASSERT_EQ(both.numDistant(), fine.numDistant() + coarse.numDistant());

    Points g = Points::Zero(3, x.cols()), alone = g;
    const double energy = both.addGradient(x, &g);
    const double of_tool = fine.addGradient(x, &alone), of_bone = coarse.addGradient(x, &alone);
    ASSERT_GT(of_tool, 0.0);
    ASSERT_GT(of_bone, 0.0);
    ASSERT_NEAR(energy, of_tool + of_bone, 1e-12 * energy);
    ASSERT_LT((g - alone).norm(), 1e-12 * g.norm());
  }
}

// Each set stands for the whole surface.
TEST_F(AnatomySamples, BearTheWholeSurface) {
  const auto areaOf = [&](int first, int end) {
    double sum = 0.0;
    for (int s = first; s < end; ++s) sum += both.samples()[static_cast<std::size_t>(s)].area;
    return sum;
  };
  const auto all = static_cast<int>(both.samples().size());
  EXPECT_NEAR(areaOf(0, both.numForInstruments()), 0.0096, 1e-12);
  EXPECT_NEAR(areaOf(both.numForInstruments(), all), 0.0096, 1e-12);
  EXPECT_GT(both.numForInstruments(), 10 * (all - both.numForInstruments()));
}

// With another mesh of the same block those samples go on that were of the same kind.
TEST_F(AnatomySamples, GoOnWithTheirOwnKind) {
  ResponseSettings settings;
  settings.model = "augmented_lagrangian";
  settings.friction_with.usual = {0.5, 0.3, 0.0};
  ContactPotential old(sampleSurface(x, triangles, kFine), makeResponse(settings));
  ContactPotential next(sampleSurface(x, triangles, kFine), makeResponse(settings));
  for (ContactPotential* potential : {&old, &next}) {
    potential->addAnatomySamples(x, triangles, kCoarse);
    potential->setObstacles(obstacles());
    potential->findCandidates(x, {0.002, 0.002});
  }
  old.beginStep(x);
  old.learn(x, 0.01);
  old.endStep(x);
  next.goOnFrom(old, mesh.points, mesh.points);
  next.beginStep(x);
  Points g = Points::Zero(3, x.cols()), h = g;
  old.beginStep(x);
  old.addGradient(x, &g);
  next.addGradient(x, &h);
  EXPECT_GT(g.norm(), 0.0);
  EXPECT_EQ(g, h);
}

}  // namespace
}  // namespace palpate::contact::anatomy_samples_test
