// SPDX-License-Identifier: GPL-3.0-or-later
// Each rung of what an organ does where a step fails, as the report tells it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "liver_slab.h"

namespace palpate::tissue::recovery_test {
namespace {

using test::LiverPress;
using test::LiverSlab;
constexpr double kStep = 0.01;

int told(Recovery recovery) { return static_cast<int>(recovery); }

LiverSlab smallSlab() {
  LiverSlab slab("implicit_pcg", Eigen::Vector3i(5, 5, 3), "tet4");
  slab.settings.mass_damping = 60.0;
  return slab;
}

// One that fails wherever a tool goes on.
LiverSlab failingSlab() {
  LiverSlab slab = smallSlab();
  slab.settings.only_converged = true;
  slab.settings.max_newton_iterations = 1;
  slab.settings.max_time_steps = 1;
  slab.settings.tolerance = 1e-9;
  return slab;
}

TEST(Recovery, IsNoneWhereAStepIsSolved) {
  const auto tissue = smallSlab().make();
  for (LiverPress press(0.006, 0.05); press.time() < 0.3;) {
    const TissueStep& step = tissue->step({press.next()}, kStep);
    EXPECT_TRUE(step.ok());
    EXPECT_EQ(step.recovery, told(Recovery::kNone)) << press.time();
  }
}

// A tool that presses the slab to a fifth: elements come near to being turned inside out.
TEST(Recovery, SolvesAgainOrInShorterStepsWhereElementsGetFlat) {
  const auto tissue = smallSlab().make();
  int worst = 0;
  for (LiverPress press(0.032, 0.1); press.time() < 0.6;) {
    const TissueStep& step = tissue->step({press.next()}, kStep);
    EXPECT_TRUE(solver::usable(step.status));
    EXPECT_GT(step.min_jacobian, 0.0);
    EXPECT_EQ(step.time_steps > 1, step.recovery >= told(Recovery::kShorterSteps));
    worst = std::max(worst, step.recovery);
  }
  EXPECT_GE(worst, told(Recovery::kSolvedAgain));
  EXPECT_LE(worst, told(Recovery::kShorterSteps));
}

TEST(Recovery, TakesShorterStepsWhereOneFails) {
  LiverSlab slab = smallSlab();
  slab.settings.only_converged = true;
  slab.settings.max_newton_iterations = 2;
  const auto tissue = slab.make();
  int worst = 0;
  for (LiverPress press(0.01, 0.3); press.time() < 0.1;) {
    const TissueStep& step = tissue->step({press.next()}, kStep);
    if (!step.ok()) continue;
    EXPECT_EQ(step.time_steps > 1, step.recovery == told(Recovery::kShorterSteps));
    worst = std::max(worst, step.recovery);
  }
  EXPECT_EQ(worst, told(Recovery::kShorterSteps));
}

// Folded through itself and at rest: no force leads out of it.
TEST(Recovery, PutsBackWhatRestsTurnedInsideOut) {
  LiverSlab slab = smallSlab();
  slab.law = LiverSlab::liver("st_venant_kirchhoff", 0.3);
  const auto tissue = slab.make();
  Points x = slab.mesh.points;
  x.row(2) *= -1.0;  // through the plane that holds it
  tissue->setPositions(0, x, Points::Zero(3, x.cols()));
  int worst = 0;
  bool slept = false;
  for (int k = 0; k < 2000 && !slept; ++k) {
    const TissueStep& step = tissue->step({}, kStep);
    EXPECT_FALSE(step.ok() && step.min_jacobian <= 0.0) << k;
    worst = std::max(worst, step.recovery);
    slept = step.slept;
  }
  EXPECT_TRUE(slept);
  EXPECT_EQ(worst, told(Recovery::kPutBack));
  EXPECT_LT((tissue->positions() - slab.mesh.points).cwiseAbs().maxCoeff(), 1e-4 * 0.1);
  EXPECT_EQ(tissue->step({}, kStep).recovery, told(Recovery::kNone));
}

// Viscous and folded it takes iterations in each cycle for good, which lead to where they began.
TEST(Recovery, PutsBackWhatIterationsLeaveTurnedInsideOut) {
  for (const int cells : {2, 3}) {
    LiverSlab slab("implicit_pcg", Eigen::Vector3i(cells, cells, 2), "tet10");
    slab.law = material::makeMaterial("stable_neo_hookean",
                                      {{"young_modulus", {3.7e3}}, {"poisson_ratio", {0.3}}});
    slab.prony = {{0.166, 5.66e-6}};
    slab.density = 1.25;
    slab.settings.gravity.setZero();
    slab.settings.mass_damping = 1800.0;
    const auto tissue = slab.make();
    const Points rest = slab.mesh.points;
    Points x = rest;
    x.row(2) *= -1.0;
    tissue->setPositions(0, x, Points::Zero(3, x.cols()));
    int worst = 0;
    for (int k = 0; k < 250; ++k) worst = std::max(worst, tissue->step({}, 0.0026).recovery);
    EXPECT_EQ(worst, told(Recovery::kPutBack)) << cells;
    EXPECT_TRUE(tissue->step({}, 0.0026).ok()) << cells;
    EXPECT_LT((tissue->positions() - rest).cwiseAbs().maxCoeff(), 1e-9) << cells;
  }
}

// Next to the incompressible it trembles by micrometres, each cycle with iterations, for ever.
TEST(Recovery, PutsBackWhatTremblesTurnedInsideOut) {
  LiverSlab slab("implicit_pcg", Eigen::Vector3i(4, 4, 3), "p1p1");
  slab.law = LiverSlab::liver("stable_neo_hookean", 0.4999);
  slab.settings.mass_damping = 60.0;
  const auto tissue = slab.make();
  const Points& rest = slab.mesh.points;
  const Vec3 middle = rest.rowwise().mean();
  const Points inverted = (-rest).colwise() + 2.0 * middle;
  const Points x = rest + (inverted - rest).cwiseProduct(slab.free);
  tissue->setPositions(0, x, Points::Zero(3, x.cols()));
  int worst = 0, k = 0;
  for (bool slept = false; k < 400 && !slept; ++k) {
    const TissueStep& step = tissue->step({}, 0.005);
    EXPECT_FALSE(step.ok() && step.min_jacobian <= 0.0) << k;
    worst = std::max(worst, step.recovery);
    slept = step.slept;
  }
  EXPECT_LT(k, 120);
  EXPECT_EQ(worst, told(Recovery::kPutBack));
  EXPECT_LT((tissue->positions() - rest).cwiseAbs().maxCoeff(), 1e-4 * 0.1);
}

TEST(Recovery, RollsBackWhatAllFailIn) {
  const LiverSlab slab = smallSlab();
  const auto tissue = slab.make();
  Points v = tissue->velocities();
  v(0, slab.mesh.numPoints() - 1) = std::numeric_limits<double>::infinity();
  tissue->setPositions(0, slab.mesh.points, v);
  const TissueStep& step = tissue->step({}, kStep);
  EXPECT_EQ(step.recovery, told(Recovery::kRolledBack));
  EXPECT_EQ(tissue->positions(), slab.mesh.points);
  EXPECT_EQ(tissue->step({}, kStep).recovery, told(Recovery::kNone));
}

// Asked to end where the first solve failed and shorter steps were next.
TEST(Recovery, IsOnlyLateWhereThereIsNoTimeForShorterSteps) {
  const LiverSlab slab = smallSlab();
  const auto tissue = slab.make();
  Points v = tissue->velocities();
  v(0, slab.mesh.numPoints() - 1) = std::numeric_limits<double>::infinity();
  tissue->setPositions(0, slab.mesh.points, v);
  const solver::Interrupt at_once = [] { return true; };
  tissue->setInterrupt(&at_once);
  const TissueStep& step = tissue->step({}, kStep);
  EXPECT_EQ(step.status, solver::SolveStatus::kDeadline);
  EXPECT_EQ(step.recovery, told(Recovery::kRolledBack));
  EXPECT_EQ(step.time_steps, 1);
}

// Ten failures freeze an organ; to be late is none.
TEST(Recovery, IsNeverFrozenForBeingLate) {
  const auto tissue = failingSlab().make();
  const solver::Interrupt at_once = [] { return true; };
  tissue->setInterrupt(&at_once);
  LiverPress press(0.02, 0.05);
  int late = 0;
  for (int k = 0; k < 40; ++k) {
    const TissueStep& step = tissue->step({press.next()}, kStep);
    EXPECT_LT(step.recovery, told(Recovery::kFrozen)) << k;
    late += step.status == solver::SolveStatus::kDeadline;
  }
  EXPECT_GT(late, 15);
}

TEST(Recovery, FreezesWhatFailsAgainAndAgainUntilTheToolsLeave) {
  const auto tissue = failingSlab().make();
  LiverPress press(0.02, 0.05);
  TissueStep step;
  int failed = 0, frozen = 0;
  Points kept;
  for (int k = 0; k < 40; ++k) {
    step = tissue->step({press.next()}, kStep);
    EXPECT_TRUE(tissue->positions().allFinite());
    failed += step.recovery == told(Recovery::kRolledBack);
    if (step.recovery != told(Recovery::kFrozen)) continue;
    if (frozen++ == 0) kept = tissue->positions();
    EXPECT_FALSE(step.ok());
    EXPECT_EQ(step.newton_iterations, 0);
    EXPECT_EQ(tissue->positions(), kept);
  }
  EXPECT_GE(failed, 10);
  EXPECT_GE(frozen, 10);
  EXPECT_TRUE(tissue->step({}, kStep).ok());  // without the tool
  EXPECT_EQ(tissue->step({}, kStep).recovery, told(Recovery::kNone));
}

TEST(Recovery, TriesAFrozenOrganNowAndThen) {
  const auto tissue = failingSlab().make();
  const instrument::Geometry ball = instrument::Sphere{0.01};
  const auto at = [](int k) {  // up and down
    return poseFromXyzRpy(Vec3(0.05, 0.05, k % 2 == 0 ? 0.05 : 0.045), Vec3::Zero());
  };
  int tried = 0;
  for (int k = 0; k < 300; ++k) {
    const TissueStep& step = tissue->step({{&ball, 0, at(k), at(k + 1)}}, kStep);
    tried += step.recovery < told(Recovery::kFrozen);
  }
  EXPECT_GT(tried, 12);
  EXPECT_LT(tried, 60);
}

// Newton's method alone, from points anywhere in a cube: where it fails once it fails for good.
TEST(Recovery, PutsBackWhatFailsAgainWithoutATool) {
  LiverSlab slab = smallSlab();
  slab.settings.method = "newton_bicgstab";
  const auto tissue = slab.make();
  Points x = tissue->positions();
  const Points rest = x;
  unsigned state = 1;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    state = 1664525u * state + 1013904223u;
    if (slab.free.data()[i] != 0.0) x.data()[i] = 0.1 * (state / 4294967296.0);
  }
  tissue->setPositions(0, x, Points::Zero(3, x.cols()));
  int frozen = 0, put_back = 0;
  for (int k = 0; k < 200; ++k) {
    const TissueStep& step = tissue->step({}, kStep);
    EXPECT_NE(step.status, solver::SolveStatus::kNonFinite) << k;
    frozen += step.recovery == told(Recovery::kFrozen);
    if (step.recovery != told(Recovery::kPutBack)) continue;
    ++put_back;
    EXPECT_FALSE(step.ok());
    EXPECT_EQ(tissue->positions(), rest);
  }
  EXPECT_EQ(frozen, 50);
  EXPECT_EQ(put_back, 1);
  const TissueStep& last = tissue->step({}, kStep);
  EXPECT_TRUE(last.ok()) << solver::toString(last.status);
  EXPECT_EQ(last.recovery, told(Recovery::kNone));
}

TEST(Recovery, StaysFrozenInASavedState) {
  const LiverSlab slab = failingSlab();
  const auto one = slab.make(), other = slab.make();
  LiverPress press(0.02, 0.05);
  int k = 0;
  while (one->step({press.next()}, kStep).recovery != told(Recovery::kFrozen)) {
    ASSERT_LT(++k, 40);
  }
  other->restore(one->state());
  const contact::Obstacle next = press.next();
  EXPECT_EQ(one->step({next}, kStep).recovery, told(Recovery::kFrozen));
  EXPECT_EQ(other->step({next}, kStep).recovery, told(Recovery::kFrozen));
  EXPECT_EQ(one->positions(), other->positions());
  other->reset();
  EXPECT_EQ(other->step({}, kStep).recovery, told(Recovery::kNone));
}

}  // namespace
}  // namespace palpate::tissue::recovery_test
