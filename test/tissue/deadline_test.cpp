// SPDX-License-Identifier: GPL-3.0-or-later
// A step that is asked to end ends, by whatever method, and the next ones go on from there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "palpate/solver/minimizer_list.h"
#include "palpate/tissue/method_facts.h"
#include "slab.h"

namespace palpate::tissue::deadline_test {
namespace {

using test::kStep;
using test::Slab;

class EveryMethodThatIsLate : public ::testing::TestWithParam<std::string> {
 public:
  EveryMethodThatIsLate() : slab(Eigen::Vector3i(6, 6, 3)) {
    slab.settings.method = GetParam();
    slab.settings.mass_damping = 20.0;
    tissue = slab.make();
  }
  // A ball whose centre goes from one height to another in a cycle.
  const TissueStep& leap(double from, double to) {
    const auto at = [](double z) { return poseFromXyzRpy(Vec3(0.05, 0.05, z), Vec3::Zero()); };
    return tissue->step({{&ball, 0, at(from), at(to)}}, kStep);
  }

  const instrument::Geometry ball = instrument::Sphere{0.01};
  Slab slab;
  std::unique_ptr<TissueModel> tissue;
};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethodThatIsLate, ::testing::ValuesIn(methodNames()),
                         [](const auto& name) { return name.param; });

// At 2 m/s by 20 mm into the tissue, in many stages.
TEST_P(EveryMethodThatIsLate, EndsAfterAFewIterationsWithAStateToGoOnFrom) {
  const std::vector<std::string> minimizers = solver::minimizerNames();
  const bool minimizes = std::count(minimizers.begin(), minimizers.end(), GetParam()) > 0;
  const solver::Interrupt at_once = [] { return true; };
  const Points rest = tissue->positions();
  tissue->setInterrupt(&at_once);
  int late = 0;
  double z = 0.06;
  for (int k = 0; k < 6; ++k) {
    const double to = k < 2 ? z - 0.015 : z;
    const TissueStep& step = leap(z, to);
    z = to;
    late += step.status == solver::SolveStatus::kDeadline;
    EXPECT_LE(step.time_steps, 1) << "cycle " << k;
    // The tool goes all the way in one stage: one for each of four searches for candidates, without
    // the guard against inversion and with it.
    EXPECT_LE(step.newton_iterations, 2 * 4) << "cycle " << k;
    if (minimizes) {
      EXPECT_EQ(step.sweep_stages, 1) << "cycle " << k;
    }
    ASSERT_TRUE(tissue->positions().allFinite());
  }
  EXPECT_GT(late, 0);
  tissue->setInterrupt(nullptr);
  for (int k = 0; k < 400; ++k) tissue->step({}, kStep);
  const TissueStep& last = tissue->step({}, kStep);
  EXPECT_TRUE(last.ok()) << solver::toString(last.status);
  EXPECT_LT((tissue->positions() - rest).cwiseAbs().maxCoeff(), 1e-4 * 0.1);
}

TEST_P(EveryMethodThatIsLate, SaysThatItIsAtRestOnceThereIsTime) {
  const solver::Interrupt at_once = [] { return true; };
  tissue->setInterrupt(&at_once);
  for (int k = 0; k < 5; ++k) tissue->step({}, kStep);
  tissue->setInterrupt(nullptr);
  for (int k = 0; k < 5; ++k) tissue->step({}, kStep);
  EXPECT_EQ(tissue->step({}, kStep).status, solver::SolveStatus::kConverged);
}

// Following a tool that presses is an iteration: where the time is over then, no other is made.
TEST(LateStep, FollowsAToolWithoutAnotherIteration) {
  Slab slab;
  const auto tissue = slab.make();
  test::Press press;
  for (int k = 0; k < 30; ++k) tissue->step({press.next()}, kStep);
  const solver::Interrupt at_once = [] { return true; };
  tissue->setInterrupt(&at_once);
  for (int k = 0; k < 10; ++k) {
    const TissueStep& step = tissue->step({press.next()}, kStep);
    EXPECT_EQ(step.newton_iterations, 1) << "cycle " << k;
    EXPECT_EQ(step.status, solver::SolveStatus::kDeadline) << "cycle " << k;
  }
}

// Each cycle ends after an iteration, so that many make up what one would have done. Newton's
// method alone, quasi-static, need not find out; it must not go elsewhere.
TEST_P(EveryMethodThatIsLate, ComesOutOfAShapeThatIsInsideOut) {
  const solver::Interrupt at_once = [] { return true; };
  const Points rest = tissue->positions();
  const bool alone = GetParam() == "newton_bicgstab";
  for (int shape = 0; shape < (alone ? 1 : 10); ++shape) {
    Points x = rest;
    unsigned state = 1;
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      if (slab.free(0, i) == 0.0) continue;
      x(2, i) *= -0.5 + 0.1 * std::sin((7.0 + shape) * static_cast<double>(i));
      for (int c = 0; c < 3 && alone; ++c) {  // anywhere in a cube
        state = 1664525u * state + 1013904223u;
        x(c, i) = 0.1 * (state / 4294967296.0);
      }
    }
    tissue->setInterrupt(nullptr);
    tissue->setPositions(0, x, Points::Zero(3, x.cols()));
    tissue->setInterrupt(&at_once);
    for (int k = 0; k < (alone ? 200 : 1000); ++k) {
      tissue->step({}, kStep);
      ASSERT_LT(tissue->positions().cwiseAbs().maxCoeff(), 1.0) << "cycle " << k;
    }
    if (!alone) {
      EXPECT_LT((tissue->positions() - rest).cwiseAbs().maxCoeff(), 0.01 * 0.1) << shape;
    }
  }
}

// A stiff tool leaps in and out, with forces far above those of the tissue.
class AfterForcesThatAreGone : public EveryMethodThatIsLate {
 public:
  // The cycle with the leap is to end after it has asked `patience` times.
  void leapIn(int patience) {
    slab.settings.contact.stiffness = 3e12;
    slab.settings.integrator = "backward_euler";
    slab.settings.position_tolerance = 1e-7;
    tissue = slab.make();
    double z = 0.06;
    for (int k = 0; k < 30; ++k, z -= 0.001) tolerance = leap(z, z - 0.001).tolerance;
    int asked = 0;
    const solver::Interrupt later = [&] { return ++asked > patience; };
    tissue->setInterrupt(&later);
    leap(z, z - 0.026);
    tissue->setInterrupt(nullptr);
  }
  double tolerance = 0.0;  // before the leap [N]
};
INSTANTIATE_TEST_SUITE_P(Methods, AfterForcesThatAreGone, ::testing::ValuesIn(methodNames()),
                         [](const auto& name) { return name.param; });

// Solved to a part of them, the tissue would be at rest where it was pressed to.
TEST_P(AfterForcesThatAreGone, ACutCycleDoesNotPutItToSleep) {
  if (GetParam() == "newton_bicgstab")
    GTEST_SKIP() << "Newton's method alone fails from there, and says so";
  const Points rest = slab.make()->positions();
  leapIn(15);
  for (int k = 0; k < 401; ++k) tissue->step({}, kStep);
  EXPECT_LT((tissue->positions() - rest).cwiseAbs().maxCoeff(), 1e-4 * 0.1);
}

// Nor is it balanced by a part of them, when the cycle with them was brought to its end: what is
// left is a part of the forces that there are at its end, which the next cycle begins with.
TEST_P(AfterForcesThatAreGone, ABalanceIsOneOfThoseThatThereAre) {
  for (int patience : {15, 100000}) {
    leapIn(patience);
    double left = 0.0;
    for (int k = 0; k < 6; ++k) {
      const TissueStep& gone = tissue->step({}, kStep);
      EXPECT_LE(left, 10.0 * std::max(tolerance, gone.tolerance))
          << "before cycle " << k << " after " << patience;
      left = gone.ok() ? gone.residual : 0.0;
    }
  }
}

}  // namespace
}  // namespace palpate::tissue::deadline_test
