// SPDX-License-Identifier: GPL-3.0-or-later
// The baseline: Newton-Raphson, BiCGSTAB, contact as prescribed displacement (newton_bicgstab).
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

#include "liver_slab.h"
#include "support/contains.h"
#include "tissue/methods/prescribed/prescribed_contact.h"
#include "tissue/methods/prescribed/sparse_assembly.h"

namespace palpate::tissue::prescribed_newton_test {
namespace {

using test::LiverPress;
using test::LiverSlab;
constexpr double kStep = 0.01;

// A ball of 25 mm, several elements wide where it touches.
struct LargeBall {
  instrument::Geometry shape = instrument::Sphere{0.025};
  contact::Obstacle move(double from, double to) const {  // depths
    return {&shape, 0, at(from), at(to)};
  }
  static Pose at(double depth) {
    return poseFromXyzRpy(Vec3(0.05, 0.05, 0.065 - depth), Vec3::Zero());
  }
};

class NewtonBicgstabElement : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Elements, NewtonBicgstabElement, ::testing::Values("tet4", "anp"),
                         [](const auto& kind) { return kind.param; });

// Sticking against sliding contact, nodes against samples between them: not the same problem.
TEST_P(NewtonBicgstabElement, FeelsAboutTheForceOfTheDefaultMethod) {
  double force[2];
  int k = 0;
  for (const char* method : {"newton_bicgstab", "implicit_pcg"}) {
    LiverSlab slab(method, Eigen::Vector3i(14, 14, 5), GetParam());
    slab.settings.integrator = "static";
    const auto tissue = slab.make();
    const LargeBall ball;
    for (int step = 0; step < 8; ++step) {
      const TissueStep& done =
          tissue->step({ball.move(0.00075 * step, 0.00075 * (step + 1))}, kStep);
      ASSERT_TRUE(done.ok()) << method << " " << solver::toString(done.status);
      force[k] = test::onTool(done).z();
    }
    ++k;
  }
  EXPECT_GT(force[1], 0.5);
  EXPECT_NEAR(force[0], force[1], 0.2 * force[1]);
}

TEST_P(NewtonBicgstabElement, BalancesForcesHoldsNoPenetrationAndLetsGo) {
  LiverSlab slab("newton_bicgstab", Eigen::Vector3i(8, 8, 4), GetParam());
  slab.settings.gravity = Vec3(0.0, 0.0, -9.81);
  slab.settings.sample_spacing = 0.0;  // nodes only
  const auto tissue = slab.make();
  const Points begin = tissue->positions();
  const LargeBall ball;
  std::size_t most = 0;
  for (int k = 0; k < 16; ++k) {
    const auto depth = [](int step) { return 1e-3 * (step <= 8 ? step : 16 - step); };
    const TissueStep& step = tissue->step({ball.move(depth(k), depth(k + 1))}, kStep);
    ASSERT_TRUE(step.ok()) << k;
    EXPECT_LE(step.residual, step.tolerance);
    EXPECT_LT(test::imbalance(step).norm(),
              std::sqrt(slab.mesh.numPoints()) * step.tolerance + 1e-9);
    const Vec3 centre = LargeBall::at(depth(k + 1)).translation();
    EXPECT_GT((tissue->positions().colwise() - centre).colwise().norm().minCoeff(), 0.025 - 1e-6);
    for (const TissueContact& c : step.contacts) {  // none pulls
      EXPECT_LE(c.force_W.dot((c.p_W - centre).normalized()), 1e-9);
    }
    most = std::max(most, step.contacts.size());
  }
  EXPECT_GE(most, 5u);
  EXPECT_LE(tissue->step({}, kStep).contacts.size(), 0u);
  bool slept = false;
  for (int k = 0; k < 5 && !slept; ++k) slept = tissue->step({}, kStep).slept;
  EXPECT_TRUE(slept);
  EXPECT_LT((tissue->positions() - begin).cwiseAbs().maxCoeff(), 1e-5);
}

// Between the nodes: an edge or a triangle is moved as a whole.
TEST(NewtonBicgstab, FeelsAToolThatMissesEveryNode) {
  LiverSlab slab("newton_bicgstab", Eigen::Vector3i(8, 8, 4));
  slab.settings.sample_spacing = 0.002;
  const auto tissue = slab.make();
  const instrument::Geometry tip = instrument::Sphere{0.003};
  const auto at = [](double depth) {
    return poseFromXyzRpy(Vec3(0.05625, 0.0545, 0.043 - depth), Vec3::Zero());
  };
  double force = 0.0;
  for (int k = 0; k < 4; ++k) {
    const TissueStep& step = tissue->step({{&tip, 0, at(1e-3 * k), at(1e-3 * (k + 1))}}, kStep);
    ASSERT_TRUE(step.ok());
    EXPECT_GT(test::onTool(step).z(), force);
    force = test::onTool(step).z();
  }
}

TEST(NewtonBicgstab, SurvivesLeapsRestoreAndReset) {
  const LiverSlab slab("newton_bicgstab");
  const auto tissue = slab.make();
  const LargeBall ball;
  for (const double depth : {0.012, -0.1, 0.008}) {
    const TissueStep& step = tissue->step({ball.move(-0.05, depth)}, kStep);
    ASSERT_TRUE(tissue->positions().allFinite());
    ASSERT_TRUE(step.ok()) << solver::toString(step.status) << " at " << depth;
  }
  const Vec3 force = test::onTool(tissue->step({ball.move(0.008, 0.008)}, kStep));
  EXPECT_GT(force.z(), 0.5);
  const Points x = tissue->positions(), v = tissue->velocities();
  tissue->reset();
  EXPECT_EQ(tissue->positions(), slab.mesh.points);
  tissue->setPositions(0, x, v);
  const Vec3 again = test::onTool(tissue->step({ball.move(0.008, 0.0081)}, kStep));
  EXPECT_NEAR(again.z(), force.z(), 0.1 * force.z());
}

// Newton's steps know the tangent alone: where they squeeze an exponential law far beyond it, its
// forces may be finite and such that no iteration leads back.
TEST(NewtonBicgstab, DoesNotSqueezeAnExponentialLawBeyondReturn) {
  LiverSlab slab("newton_bicgstab", Eigen::Vector3i(5, 5, 2), "tet4");
  slab.law = material::makeMaterial("demiray", {{"a", {2000.0}}, {"b", {1.3}}, {"kappa", {2e4}}});
  const auto tissue = slab.make();
  const LargeBall ball;
  for (int k = 0; k < 40; ++k) {
    const double depth = 0.002 * (k % 20);
    const TissueStep& step = tissue->step({ball.move(-0.01, depth)}, kStep);
    ASSERT_TRUE(tissue->positions().allFinite());
    EXPECT_LT(step.tolerance, 1e3) << k;  // grows with the forces
    EXPECT_LT(step.residual, step.ok() ? 1.0 : 1e6) << k << ": " << solver::toString(step.status);
    EXPECT_LT(step.elastic_energy, 1e5) << k;  // of a slab pressed to a sixth: 2e3
  }
}

// Newton's steps look for a root of forces, which may be higher than where they began, or a saddle.
TEST(NewtonBicgstab, NeitherClimbsNorRestsOnASaddle) {
  int put_back = 0;
  for (int seed = 1; seed <= 10; ++seed) {
    LiverSlab slab("newton_bicgstab", Eigen::Vector3i(4, 4, 2), "tet4");
    slab.settings.gravity.setZero();
    const auto tissue = slab.make();
    const Points rest = tissue->positions();
    std::mt19937 random(static_cast<unsigned>(seed));
    const double most = 0.002 * seed;  // of edges of 25 mm
    std::uniform_real_distribution<double> way(-most, most);
    Points x = rest;
    for (double& c : x.reshaped()) c += way(random);
    x = rest + (x - rest).cwiseProduct(slab.free);
    tissue->setPositions(0, x, Points::Zero(3, x.cols()));
    double energy = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 120; ++k) {
      const Points before = tissue->positions();
      const TissueStep& step = tissue->step({}, kStep);
      if (step.recovery == static_cast<int>(Recovery::kPutBack)) ++put_back;
      const double left = step.ok() ? step.residual * (tissue->positions() - before).norm() : 0.0;
      ASSERT_LE(step.elastic_energy, energy * (1.0 + 1e-6) + left + 1e-12) << seed << " " << k;
      energy = step.elastic_energy;
    }
    EXPECT_LT((tissue->positions() - rest).cwiseAbs().maxCoeff(), 1e-4) << seed;
  }
  EXPECT_LT(put_back, 8);
}

// What it pulls at is let go by a solution; where there never is one it must be as well.
TEST(NewtonBicgstab, CarriesNothingAlongThatNeverConverges) {
  LiverSlab slab("newton_bicgstab", Eigen::Vector3i(8, 8, 4), "tet4");
  slab.settings.max_newton_iterations = 1;
  slab.settings.gravity.setZero();
  const auto tissue = slab.make();
  const LargeBall ball;
  const auto depth = [](int k) { return 0.002 * (k < 6 ? k : 12 - k); };
  int touched = 0;
  for (int k = 0; k < 40; ++k) {
    const TissueStep& step = tissue->step({ball.move(depth(k), depth(k + 1))}, kStep);
    touched += !step.contacts.empty();
    if (k < 30) continue;
    EXPECT_TRUE(step.contacts.empty()) << k << ", " << -depth(k + 1) << " m above";
  }
  EXPECT_GT(touched, 5);
}

TEST(NewtonBicgstab, RelaxesUnderAHeldTool) {
  LiverSlab slab("newton_bicgstab", Eigen::Vector3i(6, 6, 3));
  slab.prony = {{0.5, 0.1}};
  const auto tissue = slab.make();
  const LargeBall ball;
  double early = 0.0, late = 0.0;
  for (int k = 0; k < 60; ++k) {
    const auto depth = [](int step) { return 1e-3 * std::min(step, 6); };
    late = test::onTool(tissue->step({ball.move(depth(k), depth(k + 1))}, kStep)).z();
    if (k == 6) early = late;
  }
  EXPECT_LT(late, 0.8 * early);
  EXPECT_GT(late, 0.4 * early);
}

TEST(NewtonBicgstab, SameInputsSameBitsWhateverTheThreads) {
  ThreadPool pool(3);
  const LiverSlab slab("newton_bicgstab", Eigen::Vector3i(6, 6, 3));
  const auto one = slab.make(), two = slab.make(&pool);
  const LargeBall ball;
  for (int k = 0; k < 5; ++k) {
    const contact::Obstacle body = ball.move(1e-3 * k, 1e-3 * (k + 1));
    ASSERT_EQ(test::onTool(one->step({body}, kStep)), test::onTool(two->step({body}, kStep)));
    ASSERT_EQ(one->positions(), two->positions());
  }
}

TEST(SparseAssembly, IsTheMatrixThatMultiplies) {
  for (const char* element : {"tet4", "anp"}) {
    const LiverSlab slab("newton_bicgstab", Eigen::Vector3i(2, 2, 2), element);
    const auto elasticity =
        fem::makeElasticity(element, slab.mesh, fem::Composition::uniform(slab.law, 1060.0));
    fem::Stiffness K = elasticity->makeMatrix();
    elasticity->hessian(1.1 * slab.mesh.points, fem::Tangent::kExact, &K);
    K.scale(1.5);
    const Points x = Points::Random(3, slab.mesh.numPoints());
    Points y;
    K.multiply(x, &y);
    const Eigen::VectorXd z =
        assembleSparse(K) * Eigen::Map<const Eigen::VectorXd>(x.data(), x.size());
    EXPECT_LT((Eigen::Map<const Points>(z.data(), 3, x.cols()) - y).norm(), 1e-12 * y.norm());
  }
}

TEST(NewtonBicgstab, RefusesWhatItCannotDo) {
  const auto refusal = [](const LiverSlab& slab) -> std::string {
    try {
      slab.make();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  LiverSlab moving("newton_bicgstab");
  moving.settings.integrator = "bdf2";
  EXPECT_TRUE(test::contains(refusal(moving), "integrator = bdf2"));
  EXPECT_TRUE(test::contains(
      refusal(LiverSlab("newton_bicgstab", Eigen::Vector3i(2, 2, 2), "p1p1")), "element p1p1"));
}

// What is held can be saved, and taken up by another body of the same mesh.
TEST(PrescribedContact, GoesOnFromWhatWasSaved) {
  const LiverSlab slab("newton_bicgstab");
  const fem::Composition liver{{material::Solid{slab.law, slab.density, {}}}, {}, {}};
  const LargeBall ball;
  const auto begin = [&](FemBody* body) {
    body->tool_path.begin({ball.move(0.0, 0.003)}, body->x, 0.0);
    body->tool_path.moveTo(1.0);
    body->tool_path.search(body->x);
  };
  FemBody one(slab.mesh, liver, slab.free, slab.settings, nullptr),
      two(slab.mesh, liver, slab.free, slab.settings, nullptr);
  begin(&one);
  begin(&two);
  PrescribedContact contact(&one), other(&two);
  EXPECT_TRUE(contact.holdWhatPenetrates(one.x));
  StateWriter saved;
  contact.save(&saved);
  StateReader reader(saved.bytes());
  other.restore(&reader);
  reader.finish();
  other.beginStage(two.x, 0.0, 1.0);
  EXPECT_EQ(other.free(), contact.free());
  Points move, expected;
  other.moves(two.x, &move);
  contact.moves(one.x, &expected);
  EXPECT_GT(expected.norm(), 1e-3);
  EXPECT_EQ(move, expected);
  StateReader cut(std::string_view(saved.bytes()).substr(0, 12));
  EXPECT_THROW(other.restore(&cut), std::invalid_argument);
}

// Ten iterations of a linear solve in each cycle are less than nothing, and were the same each
// time; far from rest they may lead up.
TEST(NewtonBicgstab, ComesBackInCyclesThatAreAlwaysCut) {
  for (const double height : {1.1, 3.0}) {
    LiverSlab slab("newton_bicgstab", Eigen::Vector3i(6, 6, 3));
    slab.settings.gravity.setZero();
    const auto tissue = slab.make();
    const solver::Interrupt at_once = [] { return true; };
    tissue->setInterrupt(&at_once);
    Points x = slab.mesh.points;
    x.row(2) *= height;
    x.row(0) += 0.5 * x.row(2);
    tissue->setPositions(0, x, Points::Zero(3, x.cols()));
    const double first = tissue->step({}, kStep).elastic_energy;
    for (int k = 0; k < 100; ++k) tissue->step({}, kStep);
    EXPECT_LT(tissue->step({}, kStep).elastic_energy, 1e-6 * first) << height;
  }
}

// A ball that wanders deep in the slab, where ten iterations a cycle follow it no way.
TEST(NewtonBicgstab, IsNotTurnedInsideOutByToolsInCyclesThatAreAlwaysCut) {
  LiverSlab slab("newton_bicgstab", Eigen::Vector3i(6, 6, 3));
  slab.settings.gravity.setZero();
  const auto tissue = slab.make();
  const solver::Interrupt at_once = [] { return true; };
  tissue->setInterrupt(&at_once);
  const LargeBall ball;
  const auto depth = [](int k) { return k < 80 ? 0.03 * std::sin(0.3 * k) : -0.05; };
  double most = 0.0;
  for (int k = 0; k < 200; ++k) {
    const TissueStep& step = tissue->step({ball.move(depth(k), depth(k + 1))}, kStep);
    most = std::max(most, step.elastic_energy);
    EXPECT_GT(step.min_jacobian, 0.0) << k;
  }
  EXPECT_LT(most, 10.0);
  EXPECT_LT(tissue->step({}, kStep).elastic_energy, 1e-6);
}

}  // namespace
}  // namespace palpate::tissue::prescribed_newton_test
