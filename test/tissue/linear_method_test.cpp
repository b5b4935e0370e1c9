// SPDX-License-Identifier: GPL-3.0-or-later
// Linear elastostatics on a precomputed surface compliance (method linear_precomputed).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "liver_slab.h"
#include "support/contains.h"
#include "tissue/methods/linear/surface_compliance.h"

namespace palpate::tissue::linear_method_test {
namespace {

using test::LiverPress;
using test::LiverSlab;
constexpr double kStep = 0.01;

class LinearPrecomputedElement : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Elements, LinearPrecomputedElement,
                         ::testing::ValuesIn(fem::elementNames()),
                         [](const auto& kind) { return kind.param; });

// The same mesh, the law that is linear itself, solved as a nonlinear body would be.
TEST_P(LinearPrecomputedElement, IsTheFemSolveWithTheLinearLaw) {
  std::vector<Vec3> forces[2];
  Points x[2];
  int k = 0;
  for (const char* method : {"linear_precomputed", "implicit_pcg"}) {
    LiverSlab slab(method, Eigen::Vector3i(5, 5, 3), GetParam());
    slab.law = LiverSlab::liver("linear", 0.45);
    slab.settings.integrator = "static";
    slab.settings.tolerance = 1e-8;
    slab.settings.position_tolerance = 1e-12;
    slab.settings.max_newton_iterations = 100;
    slab.settings.gravity = Vec3(0.0, 1.0, -9.81);
    const auto tissue = slab.make();
    for (LiverPress press(0.006, 0.05); press.time() < 0.2;) {
      const TissueStep& step = tissue->step({press.next()}, kStep);
      ASSERT_TRUE(step.ok()) << method << " " << solver::toString(step.status);
      forces[k].push_back(test::onTool(step));
    }
    x[k++] = tissue->positions();
  }
  EXPECT_GT(forces[1].back().z(), 0.3);
  for (std::size_t i = 0; i < forces[0].size(); ++i) {
    EXPECT_LT((forces[0][i] - forces[1][i]).norm(), 1e-5 * forces[1].back().norm()) << i;
  }
  const Points rest = LiverSlab("tled", Eigen::Vector3i(5, 5, 3), GetParam()).mesh.points;
  EXPECT_LT((x[0] - x[1]).norm(), 1e-6 * (x[1] - rest).norm());
}

TEST(LinearPrecomputed, IsTheTangentOfANonlinearLawAtRest) {
  double force[2];
  int k = 0;
  for (const char* method : {"linear_precomputed", "implicit_pcg"}) {
    LiverSlab slab(method);
    slab.settings.integrator = "static";
    const auto tissue = slab.make();
    for (LiverPress press(0.0005, 0.05); press.time() < 0.1;) {
      force[k] = test::onTool(tissue->step({press.next()}, kStep)).z();
    }
    ++k;
  }
  EXPECT_GT(force[1], 0.0);
  EXPECT_NEAR(force[0], force[1], 0.02 * force[1]);
}

TEST(LinearPrecomputed, BalancesForcesReturnsAndSleeps) {
  LiverSlab slab("linear_precomputed");
  slab.settings.gravity = Vec3(0.0, 0.0, -9.81);
  const auto tissue = slab.make();
  const Points begin = tissue->positions();
  EXPECT_LT((begin - slab.mesh.points).row(2).minCoeff(), -1e-5);  // it sags
  for (int k = 0; k < 2; ++k) tissue->step({}, kStep);
  EXPECT_TRUE(tissue->step({}, kStep).slept);
  EXPECT_EQ(tissue->positions(), begin);
  double peak = 0.0, elastic = 0.0;
  for (LiverPress press(0.01, 0.1); press.time() < 0.2;) {
    const TissueStep& step = tissue->step({press.next()}, kStep);
    ASSERT_TRUE(step.ok());
    EXPECT_LE(step.residual, step.tolerance);
    EXPECT_LT(test::imbalance(step).norm(), 30.0 * step.tolerance);
    peak = std::max(peak, test::onTool(step).z());
    elastic = step.elastic_energy;
  }
  EXPECT_GT(peak, 0.5);
  EXPECT_GT(elastic, 1e-3);
  bool slept = false;
  for (int k = 0; k < 5 && !slept; ++k) slept = tissue->step({}, kStep).slept;
  EXPECT_TRUE(slept);
  EXPECT_LT((tissue->positions() - begin).cwiseAbs().maxCoeff(), 1e-12);
}

// Quasi-static: what was before does not matter, nor how long a cycle is, but to a contact with a
// memory.
TEST(LinearPrecomputed, ForgetsItsPast) {
  LiverSlab slab("linear_precomputed");
  slab.settings.contact.model = "penalty";
  const auto slow = slab.make(), leaping = slab.make();
  const instrument::Geometry ball = instrument::Sphere{0.01};
  const auto at = [](double z) { return poseFromXyzRpy(Vec3(0.05, 0.05, z), Vec3::Zero()); };
  TissueStep a, b;
  for (int k = 0; k < 10; ++k) {
    a = slow->step({{&ball, 0, at(0.052 - 1e-3 * k), at(0.051 - 1e-3 * k)}}, 0.001 * (k + 1));
  }
  b = leaping->step({{&ball, 0, at(0.3), at(0.042)}}, kStep);
  ASSERT_TRUE(a.ok());
  ASSERT_TRUE(b.ok());
  EXPECT_LT((test::onTool(a) - test::onTool(b)).norm(), 1e-3 * test::onTool(a).norm());

  const Points x = slow->positions(), v = slow->velocities();
  slow->reset();
  slow->setPositions(0, x, v);
  const TissueStep& after = slow->step({{&ball, 0, at(0.042), at(0.042)}}, kStep);
  EXPECT_EQ(after.newton_iterations, 0);
  EXPECT_LT((slow->positions() - x).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LinearPrecomputed, TakesSeveralTools) {
  const auto tissue = LiverSlab("linear_precomputed").make();
  const instrument::Geometry ball = instrument::Sphere{0.008};
  const instrument::Geometry box = instrument::Box{Vec3(0.008, 0.008, 0.008)};
  const auto at = [](double x, double z) { return poseFromXyzRpy(Vec3(x, 0.05, z), Vec3::Zero()); };
  const auto press = [&](double from, double to) -> const TissueStep& {
    return tissue->step(
        {{&ball, 0, at(0.025, from), at(0.025, to)}, {&box, 1, at(0.075, from), at(0.075, to)}},
        kStep);
  };
  press(0.050, 0.047);
  const TissueStep& step = press(0.047, 0.044);
  ASSERT_TRUE(step.ok());
  Vec3 on[2] = {Vec3::Zero(), Vec3::Zero()};
  for (const TissueContact& c : step.contacts) on[c.owner.index] += c.force_W;
  EXPECT_GT(on[0].z(), 0.1);
  EXPECT_GT(on[1].z(), on[0].z());
}

TEST(LinearPrecomputed, SameInputsSameBitsWhateverTheThreads) {
  ThreadPool pool(3);
  const LiverSlab slab("linear_precomputed");
  const auto one = slab.make(), two = slab.make(&pool);
  for (LiverPress a(0.01, 0.2), b(0.01, 0.2); a.time() < 0.2;) {
    ASSERT_EQ(test::onTool(one->step({a.next()}, kStep)),
              test::onTool(two->step({b.next()}, kStep)));
    ASSERT_EQ(one->positions(), two->positions());
  }
}

TEST(LinearPrecomputed, AThinFastToolDoesNotPassThrough) {
  LiverSlab slab("linear_precomputed");
  slab.settings.sample_spacing = 0.0005;
  const auto tissue = slab.make();
  const instrument::Geometry needle = instrument::Capsule{0.001, 0.03};
  const auto at = [](double z) {
    return poseFromXyzRpy(Vec3(0.05, 0.05, z), Vec3(0.0, M_PI / 2, 0.0));
  };
  double last = 0.0;
  for (int k = 0; k < 6; ++k) {
    const double z = 0.05 - 0.005 * k;
    const TissueStep& step = tissue->step({{&needle, 0, at(z), at(z - 0.005)}}, kStep);
    ASSERT_TRUE(tissue->positions().allFinite());
    if (z - 0.005 > 0.04) continue;
    EXPECT_GT(test::onTool(step).z(), last);
    last = test::onTool(step).z();
  }
}

TEST(LinearPrecomputed, KeepsNineNumbersForEachPairOfSurfaceNodes) {
  const LiverSlab slab("linear_precomputed");  // 9 x 9 x 5 nodes, the bottom held
  const auto elasticity =
      fem::makeElasticity("anp", slab.mesh, fem::Composition::uniform(slab.law, 1060.0));
  const auto triangles = mesh::trianglesOf(mesh::boundaryFaces(slab.mesh));
  const SurfaceCompliance compliance(elasticity.get(), slab.free, slab.mesh.points, triangles);
  const std::size_t movable = 9 * 9 + 3 * 4 * 8;
  EXPECT_EQ(compliance.memory(), 9 * sizeof(double) * movable * movable);
}

std::string refusal(const LiverSlab& slab) {
  try {
    slab.make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(LinearPrecomputed, RefusesABodyWithTooLargeASurface) {
  const std::string message =
      refusal(LiverSlab("linear_precomputed", Eigen::Vector3i(42, 42, 2), "tet4"));
  EXPECT_TRUE(test::contains(message, "the surface has 2017 nodes that can move"));
  EXPECT_TRUE(test::contains(message, "enlarge edge_length"));
}

TEST(LinearPrecomputed, RefusesWhatItCannotDo) {
  LiverSlab moving("linear_precomputed");
  moving.settings.integrator = "bdf2";
  EXPECT_TRUE(test::contains(refusal(moving), "integrator = bdf2"));
  LiverSlab viscous("linear_precomputed");
  viscous.prony = {{0.5, 0.2}};
  EXPECT_TRUE(test::contains(refusal(viscous), "viscoelastic"));
  LiverSlab loose("linear_precomputed");
  loose.free.setOnes();
  EXPECT_TRUE(test::contains(refusal(loose), "translation along x"));
}

}  // namespace
}  // namespace palpate::tissue::linear_method_test
