// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/contact_potential.h"

#include <gtest/gtest.h>

#include "palpate/contact/signed_distance.h"
#include "palpate/mesh/tet_mesh.h"
#include "support/random.h"

namespace palpate::contact::contact_potential_test {
namespace {

using instrument::Box;
using instrument::Capsule;
using instrument::Geometry;
using instrument::Sphere;

const Geometry kShapes[] = {Sphere{0.03}, Capsule{0.02, 0.01}, Box{Vec3(0.02, 0.03, 0.025)}};

class ContactWithEveryShape : public ::testing::TestWithParam<int> {
 protected:
  ContactWithEveryShape() {
    potential.setObstacles({body});
    potential.findCandidates(mesh.points, {1.0});
  }

  fem::Stiffness matrix() const {
    std::vector<std::pair<int, int>> pairs;
    for (Eigen::Index e = 0; e < mesh.numTets(); ++e) {
      for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < a; ++b) pairs.emplace_back(mesh.tets(a, e), mesh.tets(b, e));
      }
    }
    return fem::Stiffness(fem::BlockMatrix(static_cast<int>(mesh.numPoints()), pairs));
  }

  test::Random random;
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.1, 0.05), Eigen::Vector3i(5, 5, 3));
  Pose X_WG = poseFromXyzRpy(Vec3(0.051, 0.047, 0.065), Vec3(0.2, 0.1, 0.3));
  Obstacle body{&kShapes[GetParam()], 0, X_WG, X_WG};
  ContactPotential potential{sampleSurface(mesh.points, mesh::boundaryTriangles(mesh.tets), 0.01),
                             makeResponse({"penalty", 1e6, 2e-3})};
};

TEST_P(ContactWithEveryShape, GradientIsThatOfTheValue) {
  Points g = Points::Zero(3, mesh.numPoints());
  EXPECT_DOUBLE_EQ(potential.addGradient(mesh.points, &g), potential.value(mesh.points));
  EXPECT_GT(g.norm(), 0.0);
  constexpr double h = 1e-7;
  for (int trial = 0; trial < 10; ++trial) {
    const Points d = random.points(mesh.numPoints(), 1.0);
    const double slope =
        (potential.value(mesh.points + h * d) - potential.value(mesh.points - h * d)) / (2.0 * h);
    EXPECT_NEAR(g.cwiseProduct(d).sum(), slope, 1e-5 * g.norm() * d.norm());
  }
}

TEST_P(ContactWithEveryShape, HessianIsThatOfTheGradient) {
  fem::Stiffness K = matrix();
  potential.addHessian(mesh.points, fem::Tangent::kExact, &K);
  constexpr double h = 1e-8;
  for (int trial = 0; trial < 5; ++trial) {
    const Points d = random.points(mesh.numPoints(), 1.0);
    Points Kd, plus = Points::Zero(3, mesh.numPoints()), minus = plus;
    K.multiply(d, &Kd);
    potential.addGradient(mesh.points + h * d, &plus);
    potential.addGradient(mesh.points - h * d, &minus);
    EXPECT_LT((Kd - (plus - minus) / (2.0 * h)).norm(), 1e-4 * Kd.norm());
  }
}

TEST_P(ContactWithEveryShape, PushIsWhatTouchesGainWhenTheToolMoves) {
  const auto forces = [&](const Pose& motion) {
    const Pose X_WG_moved = motion * X_WG;
    potential.setObstacles({{body.geometry, 0, X_WG_moved, X_WG_moved}});
    Points g = Points::Zero(3, mesh.numPoints());
    potential.addGradient(mesh.points, &g);
    return Points(-g);
  };
  const Pose there = poseFromXyzRpy(Vec3(2e-7, 1e-7, -3e-7), Vec3(2e-6, -1e-6, 3e-6));
  const Points gained = 0.5 * (forces(there) - forces(there.inverse()));
  forces(Pose::Identity());
  Points push = Points::Zero(3, mesh.numPoints());
  ASSERT_TRUE(potential.addPush(mesh.points, {there}, &push));
  EXPECT_LT((push - gained).norm(), 1e-3 * push.norm());
  Points none = Points::Zero(3, mesh.numPoints());
  EXPECT_FALSE(potential.addPush(mesh.points, {Pose::Identity()}, &none));
  EXPECT_TRUE(none.isZero(0.0));
}

TEST_P(ContactWithEveryShape, ProjectedHessianIsPositiveSemidefinite) {
  fem::Stiffness K = matrix();
  potential.addHessian(mesh.points, fem::Tangent::kProjected, &K);
  for (int trial = 0; trial < 50; ++trial) {
    const Points d = random.points(mesh.numPoints(), 1.0);
    Points Kd;
    K.multiply(d, &Kd);
    EXPECT_GE(Kd.cwiseProduct(d).sum(), -1e-9 * Kd.norm() * d.norm());
  }
}

TEST_P(ContactWithEveryShape, ToolFeelsTheOppositeOfTheTissue) {
  Points g = Points::Zero(3, mesh.numPoints());
  potential.addGradient(mesh.points, &g);
  std::vector<Contact> contacts;
  potential.collect(mesh.points, &contacts);
  Vec3 on_tool = Vec3::Zero(), moment_on_tool = Vec3::Zero(), moment_on_tissue = Vec3::Zero();
  for (const Contact& c : contacts) {
    on_tool += c.force_W;
    moment_on_tool += c.touch.p_W.cross(c.force_W);
    EXPECT_GT(c.touch.penetration(), 0.0);
  }
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    moment_on_tissue -= Vec3(mesh.points.col(i)).cross(Vec3(g.col(i)));
  }
  EXPECT_LT((on_tool - g.rowwise().sum()).norm(), 1e-12 * on_tool.norm());
  EXPECT_LT((moment_on_tool + moment_on_tissue).norm(), 1e-12 * on_tool.norm());
  EXPECT_GT(on_tool.z(), 0.0);  // the tool is above and is pushed up
}

TEST_P(ContactWithEveryShape, CandidatesWithinReachAreAllThatTouch) {
  std::vector<Contact> all, near;
  potential.collect(mesh.points, &all);
  potential.findCandidates(mesh.points, {1e-9});
  potential.collect(mesh.points, &near);
  ASSERT_EQ(all.size(), near.size());
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i].touch.sample, near[i].touch.sample);
  EXPECT_GT(all.size(), 5u);
}

// Samples with an offset from the triangles that carry them.
TEST_P(ContactWithEveryShape, GradientAndCandidatesHoldWithOffsets) {
  const Points offsets =
      random.points(static_cast<Eigen::Index>(potential.samples().size()), 0.004);
  potential.setOffsets(offsets);
  EXPECT_EQ(potential.samples()[3].position(mesh.points),
            potential.samples()[3].of(mesh.points) + offsets.col(3));
  potential.findCandidates(mesh.points, {1.0});
  Points g = Points::Zero(3, mesh.numPoints());
  EXPECT_DOUBLE_EQ(potential.addGradient(mesh.points, &g), potential.value(mesh.points));
  EXPECT_GT(g.norm(), 0.0);
  constexpr double h = 1e-7;
  const Points d = random.points(mesh.numPoints(), 1.0);
  const double slope =
      (potential.value(mesh.points + h * d) - potential.value(mesh.points - h * d)) / (2.0 * h);
  EXPECT_NEAR(g.cwiseProduct(d).sum(), slope, 1e-5 * g.norm() * d.norm());
  std::vector<Contact> all, near;
  potential.collect(mesh.points, &all);
  potential.findCandidates(mesh.points, {potential.reach()});
  potential.collect(mesh.points, &near);
  EXPECT_EQ(all.size(), near.size());
}

// Whatever step is proposed, no sample gets to the middle of a body, where its side would be lost.
TEST_P(ContactWithEveryShape, LongestStepKeepsEverySampleOnItsSide) {
  const double r = inscribedRadius(*body.geometry);
  const Pose X_GW = X_WG.inverse();
  for (int trial = 0; trial < 20; ++trial) {
    Points d = random.points(mesh.numPoints(), 0.1);
    d.row(2).array() += 0.1;  // up into the body
    const double longest = potential.maxStep(mesh.points, d);
    ASSERT_GT(longest, 0.0);
    ASSERT_LT(longest, 1.0);
    for (const SurfaceSample& s : potential.samples()) {
      const double before = signedDistanceValue(*body.geometry, X_GW * s.position(mesh.points));
      const double after =
          signedDistanceValue(*body.geometry, X_GW * s.position(mesh.points + longest * d));
      EXPECT_GE(after, (before >= 0.0 ? -0.5 * r : 0.5 * (before - r)) - 1e-12);
    }
  }
  EXPECT_EQ(potential.maxStep(mesh.points, Points::Zero(3, mesh.numPoints())), 1.0);
}

TEST_P(ContactWithEveryShape, FarBodiesHaveNoCandidates) {
  body.X_WG_end.translation().z() += 1.0;
  potential.setObstacles({body});
  potential.findCandidates(mesh.points, {0.01});
  EXPECT_FALSE(potential.hasCandidates());
  EXPECT_EQ(potential.value(mesh.points), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Shapes, ContactWithEveryShape, ::testing::Range(0, 3));

}  // namespace
}  // namespace palpate::contact::contact_potential_test
