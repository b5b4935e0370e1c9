// SPDX-License-Identifier: GPL-3.0-or-later
// Organs solved by boundary elements on their surface, compared with linear finite elements.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include "model_variants.h"
#include "support/contains.h"

namespace palpate::tissue::bem_test {
namespace {

using test::kStep;
using test::onTool;

const Vec3 kSize(0.04, 0.04, 0.02);

test::OrganSketch blockOf(const Eigen::Vector3i& cells, const std::string& element = "tet4") {
  test::OrganSketch organ =
      test::block("block", Vec3::Zero(), kSize, cells, [](const Vec3& X) { return X.z() <= 0.0; });
  organ.element = element;
  return organ;
}

ModelSettings settings() {
  ModelSettings s = test::variantSettings();
  s.gravity = Vec3(1.0, 2.0, -9.81);
  s.sample_spacing = 0.002;
  s.tolerance = 1e-8;
  s.position_tolerance = 1e-10;
  s.max_newton_iterations = 100;
  s.contact.model = "penalty";
  s.method = "linear_precomputed";
  return s;
}

// A ball of 8 mm that is `depth` deep at (x, 0.02).
const TissueStep& press(TissueModel* tissue, double x, double depth) {
  static const instrument::Geometry kBall = instrument::Sphere{0.008};
  const auto at = [&](double deep) {
    return Pose(Eigen::Translation3d(x, 0.02, kSize.z() + 0.008 - deep));
  };
  for (int k = 0; k < 10; ++k) {
    tissue->step({{&kBall, 0, at(0.1 * k * depth), at(0.1 * (k + 1) * depth)}}, kStep);
  }
  return tissue->step({{&kBall, 0, at(depth), at(depth)}}, kStep);
}

// Where the points of a grid 10 mm wide on the top have gone at rest.
Points topOf(const TissueModel& tissue) {
  const Points x = tissue.positions();
  Points moved = Points::Zero(3, 25);
  for (Eigen::Index k = 0; k < 25; ++k) {
    const Vec3 X(0.01 * static_cast<double>(k % 5), 0.01 * static_cast<double>(k / 5), kSize.z());
    Eigen::Index nearest = 0;
    (x.colwise() - X).colwise().squaredNorm().minCoeff(&nearest);
    moved.col(k) = x.col(nearest) - X;
  }
  return moved;
}

// Two meshes of each, h = 10 and 5 mm. Held edges are singular, of first order to both: what is
// left to go is no more than the last change.
TEST(BoundaryElements, SagAsLinearElements) {
  const auto sag = [](const std::string& model, int n) {
    const test::OrganSketch block = blockOf(Eigen::Vector3i(2 * n, 2 * n, n), "tet10");
    return topOf(*test::makeOrgans({block}, settings(), nullptr, model));
  };
  const Points bem = sag("bem", 4), fem = sag("fem", 4);
  const double left = (bem - sag("bem", 2)).norm() + (fem - sag("fem", 2)).norm();
  std::printf("the top under gravity: %.4g mm, by elements %.4g mm\n", 2e2 * bem.norm(),
              2e2 * fem.norm());
  EXPECT_LT((bem - fem).norm(), left);
  EXPECT_LT(left, 0.1 * fem.norm());
}

// Triangles of h = 5 mm against quadratic tetrahedra with the same edges: linear elements in a
// contact of radius a = sqrt(R d) = 4.9 mm are off by a part (h / a)^2 / 8 of what bends there.
TEST(BoundaryElements, PressBackAsFineLinearElements) {
  const Eigen::Vector3i cells(8, 8, 4);
  const double part = 0.005 * 0.005 / (0.008 * 0.003) / 8.0;
  const test::OrganSketch bem_block = blockOf(cells), fem_block = blockOf(cells, "tet10");
  const auto bem = test::makeOrgans({bem_block}, settings(), nullptr, "bem");
  const auto fem = test::makeOrgans({fem_block}, settings());
  for (const double x : {0.02, 0.012}) {
    const TissueStep b = press(bem.get(), x, 0.003);
    const TissueStep f = press(fem.get(), x, 0.003);
    ASSERT_TRUE(b.ok());
    ASSERT_TRUE(f.ok());
    std::printf("pressed at %g: %.4f N, by elements %.4f N\n", x, onTool(b).z(), onTool(f).z());
    EXPECT_GT(onTool(f).z(), 0.1);
    EXPECT_LT((onTool(b) - onTool(f)).norm(), part * onTool(f).norm());
    EXPECT_NEAR(b.elastic_energy, f.elastic_energy, part * f.elastic_energy);
    EXPECT_LT((b.support_force + b.gravity_force - onTool(b)).norm(), 1e-6 * onTool(b).norm());
    EXPECT_LT(b.gravity_force.norm() - f.gravity_force.norm(), 1e-9);
  }
}

// Nothing moves without a load, and what was pressed comes back to the bit.
TEST(BoundaryElements, RestWhereNothingActs) {
  ModelSettings s = settings();
  s.gravity.setZero();
  const test::OrganSketch block = blockOf(Eigen::Vector3i(4, 4, 2));
  const auto tissue = test::makeOrgans({block}, s, nullptr, "bem");
  const Points X = tissue->positions();
  EXPECT_EQ(tissue->cells(0).points, X);
  EXPECT_EQ(tissue->cells(0).cells, tissue->surfaceState(0).triangles);
  EXPECT_EQ(tissue->step({}, kStep).support_force, Vec3::Zero());
  EXPECT_EQ(tissue->positions(), X);
  EXPECT_TRUE(tissue->step({}, kStep).slept);
  press(tissue.get(), 0.02, 0.003);
  EXPECT_GT((tissue->positions() - X).norm(), 1e-3);
  tissue->step({}, kStep);
  EXPECT_EQ(tissue->positions(), X);
}

// The block's mirror image answers as its mirror image: the mesh is not symmetric, so to the
// error of its edges.
TEST(BoundaryElements, AnswerFromBothSidesAlike) {
  ModelSettings s = settings();
  s.gravity.setZero();
  const auto tissue = test::makeOrgans({blockOf(Eigen::Vector3i(8, 8, 4))}, s, nullptr, "bem");
  const Vec3 middle = onTool(press(tissue.get(), 0.02, 0.002));
  EXPECT_LT(middle.head<2>().norm(), 0.02 * middle.z());
  const Vec3 left = onTool(press(tissue.get(), 0.01, 0.002));
  const Vec3 right = onTool(press(tissue.get(), 0.03, 0.002));
  EXPECT_LT(Vec3(left.x() + right.x(), left.y() - right.y(), left.z() - right.z()).norm(),
            0.02 * middle.z());
}

// The forces that held it there are contact's, from the first cycle on.
TEST(BoundaryElements, GoOnFromWhereTheyArePut) {
  const auto tissue =
      test::makeOrgans({blockOf(Eigen::Vector3i(4, 4, 2))}, settings(), nullptr, "bem");
  press(tissue.get(), 0.02, 0.003);
  const Points x = tissue->positions(), v = tissue->velocities();
  tissue->reset();
  tissue->setPositions(0, x, v);
  const TissueStep& after = press(tissue.get(), 0.02, 0.003);
  EXPECT_TRUE(after.ok());
  EXPECT_LT((tissue->positions() - x).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(BoundaryElements, RefuseWhatTheyDoNotKnow) {
  const auto refusal = [](const std::function<void(test::OrganSketch*, ModelSettings*)>& change) {
    test::OrganSketch block = blockOf(Eigen::Vector3i(3, 3, 2));
    ModelSettings s = settings();
    change(&block, &s);
    try {
      test::makeOrgans({block}, s, nullptr, "bem");
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  using test::contains;
  using Sketch = test::OrganSketch;
  EXPECT_EQ(refusal([](Sketch*, ModelSettings*) {}), "none");
  EXPECT_TRUE(contains(refusal([](Sketch*, ModelSettings* s) { s->needles = true; }), "needle"));
  EXPECT_TRUE(contains(refusal([](Sketch* o, ModelSettings*) {
                         o->solid.prony = {{0.3, 1.0}};
                       }),
                       "viscous"));
  EXPECT_TRUE(
      contains(refusal([](Sketch* o, ModelSettings*) { o->adapt.finest = 0.001; }), "adapt"));
  EXPECT_TRUE(contains(refusal([](Sketch* o, ModelSettings*) { o->free.setOnes(), o->held = {}; }),
                       "translation"));
  EXPECT_TRUE(
      contains(refusal([](Sketch* o, ModelSettings*) { *o = blockOf(Eigen::Vector3i(18, 18, 9)); }),
               "at most 1000"));
  EXPECT_TRUE(contains(refusal([](Sketch* o, ModelSettings*) {
                         const mesh::TetMesh one = o->mesh;
                         const Eigen::Index n = one.numPoints(), m = one.numTets();
                         o->mesh.points.conservativeResize(3, 2 * n);
                         o->mesh.points.rightCols(n) = one.points.colwise() + Vec3(0.1, 0.0, 0.0);
                         o->mesh.tets.conservativeResize(4, 2 * m);
                         o->mesh.tets.rightCols(m) = one.tets.array() + static_cast<int>(n);
                       }),
                       "2 bodies"));
}

}  // namespace
}  // namespace palpate::tissue::bem_test
