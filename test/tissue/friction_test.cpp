// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue sticks to tools and slips as Coulomb's law says, in closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "liver_slab.h"
#include "palpate/solver/minimizer_list.h"
#include "support/contains.h"
#include "support/random.h"

namespace palpate::tissue::friction_test {
namespace {

using test::onTool;

FemSettings settingsWith(const contact::Friction& friction) {
  FemSettings settings;
  settings.sample_spacing = 0.01;
  settings.contact.friction_with.usual = friction;
  settings.tolerance = 1e-7;
  settings.position_tolerance = 1e-9;
  return settings;
}

// A block of 40 x 40 x 20 mm, glued to the ground or free.
std::unique_ptr<TissueModel> block(const FemSettings& settings, bool glued,
                                   double young_modulus = 10e3) {
  const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.04, 0.04, 0.02), Eigen::Vector3i(3, 3, 2));
  fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
  for (Eigen::Index i = 0; glued && i < mesh.numPoints(); ++i) {
    if (mesh.points(2, i) == 0.0) free.col(i).setZero();
  }
  const auto law = material::makeMaterial(
      "neo_hookean", {{"young_modulus", {young_modulus}}, {"poisson_ratio", {0.4}}});
  return makeFemTissue(mesh, fem::Composition::uniform(law, 1000.0), free, settings);
}

// A rigid plate, larger than the block, that goes from where it is to somewhere.
struct Plate {
  explicit Plate(const Vec3& begins) : at(begins) {}
  contact::Obstacle to(const Vec3& next) {
    const contact::Obstacle way{&shape, 0, poseFromXyzRpy(at, Vec3::Zero()),
                                poseFromXyzRpy(next, Vec3::Zero())};
    at = next;
    return way;
  }
  instrument::Geometry shape = instrument::Box{Vec3(0.3, 0.3, 0.05)};
  Vec3 at;
};
const Vec3 kBelow(0.02, 0.02, -0.05), kAbove(0.02, 0.02, 0.07);

// The block lies on a plate that accelerates: by D'Alembert's principle a slope whose tangent is
// that of both accelerations.
struct Slope {
  explicit Slope(double mu) : tissue(block(settingsWith({mu, mu}), false)) {
    for (int k = 1; k <= 150; ++k) go(std::min(1.0, k / 100.0), 0.0);
  }
  void go(double up, double tangent) {
    v += kStep * kUp * Vec3(tangent, 0.0, up);
    const TissueStep& step = tissue->step({plate.to(plate.at + kStep * v)}, kStep);
    EXPECT_EQ(step.status, solver::SolveStatus::kConverged);
  }
  /// How far the block is behind.
  double back() const { return plate.at.x() - tissue->positions().row(0).mean(); }
  /// And how much farther it is after so many steps.
  double slide(double tangent, int steps) {
    const double begin = back();
    for (int k = 0; k < steps; ++k) go(1.0, tangent);
    return back() - begin;
  }

  static constexpr double kStep = 2e-3, kUp = 2.0;  // [s], [m/s^2]
  std::unique_ptr<TissueModel> tissue;
  Plate plate{kBelow};
  Vec3 v = Vec3::Zero();
};

// A hundredth below the angle of friction, and above, where in 0.2 s it slides by 40 um and more.
TEST(Friction, HoldsABlockOnASlopeUpToTheAngleOfFriction) {
  for (const double mu : {0.2, 0.5}) {
    Slope below(mu), above(mu);
    for (int k = 0; k < 200; ++k) below.go(1.0, 0.99 * mu * k / 200);
    for (int k = 0; k < 200; ++k) above.go(1.0, 0.99 * mu * k / 200);
    below.slide(0.99 * mu, 150);  // until nothing swings
    EXPECT_LT(std::abs(below.slide(0.99 * mu, 100)), 1e-5) << mu;
    const double expected = 0.5 * Slope::kUp * 0.01 * mu * 0.04;
    EXPECT_GT(above.slide(1.01 * mu, 100), 0.5 * expected) << mu;
  }
}

TEST(Friction, LetsABlockSlideDownASlopeAsFarAsTheClosedFormSays) {
  constexpr double kMu = 0.3, kTangent = 0.9, kSeconds = 0.4;
  // Of steps with the velocity at their end.
  const double expected =
      0.5 * Slope::kUp * (kTangent - kMu) * kSeconds * (kSeconds + Slope::kStep);
  EXPECT_NEAR(Slope(kMu).slide(kTangent, 200), expected, 0.01 * expected);
}

// Nodes that are held do not yield, but friction on them ends as well where nothing presses any
// more, and what holds them feels what the tool does.
TEST(Friction, OnHeldTissueIsWhatItsSupportsFeel) {
  const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.04, 0.04, 0.02), Eigen::Vector3i(3, 3, 2));
  fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    if (mesh.points(2, i) == 0.0 || mesh.points(2, i) == 0.02) free.col(i).setZero();
  }
  const auto law =
      material::makeMaterial("neo_hookean", {{"young_modulus", {10e3}}, {"poisson_ratio", {0.4}}});
  const auto tissue =
      makeFemTissue(mesh, fem::Composition::uniform(law, 1000.0), free, settingsWith({1.0, 0.8}));
  const instrument::Geometry ball = instrument::Sphere{0.006};
  Vec3 at(0.015, 0.02, 0.027);
  double most = 0.0;
  const std::pair<Vec3, int> legs[] = {
      {Vec3(0.0, 0.0, -0.0002), 10}, {Vec3(0.0004, 0.0, 0.0), 10}, {Vec3(0.001, 0.0, 0.0005), 10}};
  for (const auto& [way, steps] : legs) {
    for (int k = 0; k < steps; ++k) {
      const Vec3 next = at + way;
      const contact::Obstacle tool{&ball, 0, poseFromXyzRpy(at, Vec3::Zero()),
                                   poseFromXyzRpy(next, Vec3::Zero())};
      at = next;
      const TissueStep& step = tissue->step({tool}, 0.01);
      ASSERT_TRUE(step.ok());
      const Vec3 sum = step.support_force + step.gravity_force + step.inertia_force - onTool(step);
      // In a step friction may exceed Coulomb's by a part of 1e-4 of what presses.
      EXPECT_LE(sum.norm(), 1e-4 * onTool(step).norm() + 1e-6) << at.transpose();
      most = std::max(most, onTool(step).norm());
    }
  }
  EXPECT_GT(most, 0.1);
}

// A plate pressed on the glued block and drawn aside.
struct Drag {
  std::unique_ptr<TissueModel> tissue;
  Plate plate{kAbove};
  double h = 0.01;

  explicit Drag(const contact::Friction& friction, const std::string& method = "implicit_pcg",
                double damping = 50.0) {
    FemSettings settings = settingsWith(friction);
    settings.method = method;
    settings.mass_damping = damping;
    tissue = block(settings, true);
  }
  const TissueStep& by(const Vec3& way) {
    const TissueStep& step = tissue->step({plate.to(plate.at + way)}, h);
    EXPECT_TRUE(solver::usable(step.status)) << solver::toString(step.status);
    return step;
  }
  const TissueStep& press(double depth) {
    for (int k = 0; k < 20; ++k) by(Vec3(0.0, 0.0, -depth / 20));
    return by(Vec3::Zero());
  }
};

class EveryMethodWithFriction : public ::testing::TestWithParam<std::string> {};
std::vector<std::string> methods() {
  std::vector<std::string> names = solver::minimizerNames();
  names.insert(names.end(), {"tled", "linear_precomputed"});
  return names;
}
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethodWithFriction, ::testing::ValuesIn(methods()),
                         [](const auto& name) { return name.param; });

TEST_P(EveryMethodWithFriction, DragsWithTheKineticForceAndBalances) {
  constexpr double kMu = 0.4;
  Drag drag({kMu, kMu}, GetParam());
  drag.press(1e-3);
  const TissueStep* step = nullptr;
  for (int k = 0; k < 60; ++k) {
    step = &drag.by(Vec3(1e-4, 0.0, 0.0));
    for (const TissueContact& c : step->contacts) {
      EXPECT_LE(c.force_W.head<2>().norm(), kMu * c.force_W.z() * (1.0 + 1e-10)) << k;
    }
    EXPECT_LE(test::imbalance(*step).norm(), 2e-3 * onTool(*step).norm() + 1e-4) << k;
  }
  const Vec3 force = onTool(*step);
  EXPECT_GT(force.z(), 0.5);
  EXPECT_NEAR(-force.x(), kMu * force.z(), 0.01 * kMu * force.z());
  EXPECT_LT(std::abs(force.y()), 0.01 * force.z());
}

TEST(Friction, DoesNotCreepWhileItSticks) {
  Drag drag({0.6, 0.4});
  drag.press(1e-3);
  for (int k = 0; k < 20; ++k) drag.by(Vec3(5e-6, 0.0, 0.0));
  for (int k = 0; k < 100; ++k) drag.by(Vec3::Zero());
  const Vec3 force = onTool(drag.by(Vec3::Zero()));
  const Points x = drag.tissue->positions();
  EXPECT_GT(std::abs(force.x()), 0.01 * force.z());
  for (int k = 0; k < 1000; ++k) drag.by(Vec3(0.0, 0.0, 0.0));
  EXPECT_LT((onTool(drag.by(Vec3::Zero())) - force).norm(), 1e-6 * force.norm());
  EXPECT_LT((drag.tissue->positions() - x).cwiseAbs().maxCoeff(), 1e-9);
}

// A stiff block on springs lies on a belt: it goes along until the springs draw by the static
// friction, swings back about where they draw by the kinetic one, and sticks where it has the
// belt's velocity again: as far on the other side of that.
TEST(Friction, SticksAndSlipsByTurnsWhereItsCoefficientsDiffer) {
  constexpr double kStatic = 0.5, kKinetic = 0.3, kPress = 1e-3, kBelt = 0.05, kStep = 1.5e-4;
  constexpr double kNormal = 2e6, kTangential = 2e5;  // [Pa/m]
  constexpr double kHeight = 2e-3;                    // so flat that it hardly rocks
  const mesh::TetMesh mesh = mesh::boxMesh(Vec3(0.04, 0.04, kHeight), Eigen::Vector3i(3, 3, 1));
  Surroundings springs(fem::FreeMask::Ones(3, mesh.numPoints()));
  std::vector<int> bottom;
  for (int i = 0; i < static_cast<int>(mesh.numPoints()); ++i) {
    if (mesh.points(2, i) == 0.0) bottom.push_back(i);
  }
  springs.springs.push_back({bottom, {kNormal, kTangential, 0.0, 0.0}, std::nullopt});
  const auto law =
      material::makeMaterial("neo_hookean", {{"young_modulus", {1e9}}, {"poisson_ratio", {0.0}}});
  FemSettings settings = settingsWith({kStatic, kKinetic});
  settings.contact.model = "penalty";
  settings.contact.stiffness = 2e8;  // the block is rigid against it: all points slip at once
  const auto tissue =
      makeFemTissue(mesh, fem::Composition::uniform(law, 1000.0), springs, settings);
  Plate belt(kBelow);
  for (int k = 0; k < 200; ++k) tissue->step({belt.to(belt.at + Vec3(0, 0, kPress / 200))}, 1e-3);
  for (int k = 0; k < 200; ++k) tissue->step({belt.to(belt.at)}, 1e-3);
  // The springs are pressed together by this, and drawn so far by friction of one.
  const double pressed = tissue->positions().row(2).mean() - mesh.points.row(2).mean();
  const double whole = kNormal / kTangential * pressed;
  const double begin = tissue->positions().row(0).mean();
  std::vector<double> turns;  // highest and lowest places in turn
  double x = 0.0, before = 0.0, before_that = 0.0;
  for (int k = 0; k < 2600; ++k) {
    tissue->step({belt.to(belt.at + Vec3(kStep * kBelt, 0.0, 0.0))}, kStep);
    before_that = std::exchange(before, x);
    x = tissue->positions().row(0).mean() - begin;
    const bool turn = (before - before_that) * (x - before) < 0.0 && before > 1e-4;
    if (turn && (turns.empty() || std::abs(turns.back() - before) > 0.1 * whole)) {
      turns.push_back(before);
    }
  }
  ASSERT_GE(turns.size(), 5U);
  // Going on with the belt's velocity it swings a little farther than where the friction begins to
  // be too little; backward Euler takes 1 - exp(-w^2 h T / 4) of the amplitude in half a period T.
  const double w = std::sqrt(kTangential / (1000.0 * kHeight));
  const double swing = std::hypot((kStatic - kKinetic) * whole, kBelt / w);
  const double lost = 1.0 - std::exp(-w * kStep * 3.15 / 2.0);
  for (std::size_t k = 0; k + 1 < turns.size(); k += 2) {
    EXPECT_NEAR(turns[k], kKinetic * whole + swing, 0.02 * whole) << k;
    EXPECT_NEAR(turns[k + 1], kKinetic * whole - swing, 0.02 * whole + lost * swing) << k;
  }
}

// A ball that goes, turns and hops at random on the slab.
struct RandomBall {
  instrument::Geometry shape = instrument::Sphere{0.01};
  test::Random random;
  Pose X = poseFromXyzRpy(Vec3(0.02, 0.02, 0.031), Vec3::Zero());
  Vec3 v = Vec3::Zero(), w = Vec3::Zero();

  contact::Obstacle next(double h) {
    v += random.vector(0.02) - 0.05 * v;
    w += random.vector(2.0) - 0.05 * w;
    Vec3 p = X.translation() + h * v;
    for (int k = 0; k < 2; ++k) {
      if (std::abs(p[k] - 0.02) > 0.008) v[k] = -v[k];
    }
    if (p.z() < 0.0275 || p.z() > 0.031) v.z() = -v.z();
    p = X.translation() + h * v;
    Pose next = X;
    next.linear() = Eigen::AngleAxisd(h * w.norm(), w.normalized()).toRotationMatrix() * X.linear();
    next.translation() = p;
    const contact::Obstacle way{&shape, 0, X, next};
    X = next;
    return way;
  }
};

TEST_P(EveryMethodWithFriction, NeverLeavesItsConeAndBalances) {
  constexpr double kMu = 0.3;
  FemSettings settings = settingsWith({kMu, kMu});
  settings.sample_spacing = 0.003;
  settings.method = GetParam();
  const auto tissue = block(settings, true);
  RandomBall ball;
  int contacts = 0, sliding = 0, sub_steps = 0;
  double worst = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const TissueStep& step = tissue->step({ball.next(0.01)}, 0.01);
    ASSERT_TRUE(solver::usable(step.status)) << k;
    sub_steps += step.sweep_stages;
    for (const TissueContact& c : step.contacts) {
      const Vec3 n = (c.p_W - ball.X.translation()).normalized();  // into the tissue
      const double pressing = -n.dot(c.force_W);
      const double along = (c.force_W + pressing * n).norm();
      EXPECT_LE(along, kMu * pressing * (1.0 + 1e-9) + 1e-15) << k;
      ++contacts;
      sliding += along > 0.99 * kMu * pressing ? 1 : 0;
    }
    worst = std::max(worst, test::imbalance(step).norm() / std::max(onTool(step).norm(), 0.01));
  }
  EXPECT_GT(contacts, 1000);
  EXPECT_GT(sliding, contacts / 20);
  EXPECT_LT(sliding, contacts);
  EXPECT_LT(worst, 1e-3);
  if (GetParam() == "tled") {
    EXPECT_GT(sub_steps, 4 * 1000);  // it did not give up: implicit steps take one or two
  }
}

// Cycles that are asked to end after so many questions say so, or are balanced.
TEST_P(EveryMethodWithFriction, BalancesOrSaysThatItWasCut) {
  FemSettings settings = settingsWith({0.3, 0.3});
  settings.sample_spacing = 0.003;
  settings.method = GetParam();
  const auto tissue = block(settings, true);
  RandomBall ball;
  int left = 0, solved = 0, cut = 0;
  const solver::Interrupt interrupt = [&] { return --left < 0; };
  tissue->setInterrupt(&interrupt);
  for (int k = 0; k < 1000; ++k) {
    left = static_cast<int>(ball.random.uniform(1.0, 60.0));
    const TissueStep& step = tissue->step({ball.next(0.01)}, 0.01);
    cut += step.status == solver::SolveStatus::kDeadline;
    if (!step.ok() || step.contacts.empty()) continue;
    ++solved;
    EXPECT_LT(test::imbalance(step).norm() / std::max(onTool(step).norm(), 0.01), 1e-3) << k;
  }
  EXPECT_GT(solved, 50);
  EXPECT_GT(cut, 50);
}

// By backward Euler of what is nearly convex, the tool does all the work that is stored, and more.
TEST(Friction, NeverCreatesEnergy) {
  FemSettings settings = settingsWith({0.6, 0.4});
  settings.sample_spacing = 0.01;
  settings.tolerance = 1e-5;
  settings.position_tolerance = 1e-7;
  const auto tissue = block(settings, true);
  RandomBall ball;
  constexpr double h = 0.01;
  double work = 0.0, least = 0.0, most_stored = 0.0;
  for (int k = 0; k < 100000; ++k) {
    const contact::Obstacle way = ball.next(h);
    const TissueStep& step = tissue->step({way}, h);
    ASSERT_TRUE(solver::usable(step.status)) << k;
    for (const TissueContact& c : step.contacts) {
      // How the ball's point went that is there now.
      const Vec3 before = way.X_WG_begin * (way.X_WG_end.inverse() * c.p_W);
      work -= c.force_W.dot(c.p_W - before);
    }
    const double stored = step.elastic_energy + step.kinetic_energy;
    most_stored = std::max(most_stored, stored);
    least = std::min(least, work - stored);
  }
  EXPECT_GT(most_stored, 1e-6);
  EXPECT_GE(least, -1e-3 * most_stored);
  EXPECT_GT(work, most_stored);
}

TEST(Friction, IsRefusedByTheMethodThatKnowsNone) {
  FemSettings settings = settingsWith({0.5, 0.5});
  settings.method = "newton_bicgstab";
  try {
    block(settings, true);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(test::contains(error.what(), "contact.friction"));
  }
}

}  // namespace
}  // namespace palpate::tissue::friction_test
