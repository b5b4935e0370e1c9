// SPDX-License-Identifier: GPL-3.0-or-later
// How much work a cycle may take that does not converge.
#include "tissue/methods/implicit/cycle_budget.h"

#include <gtest/gtest.h>

#include "slab.h"

namespace palpate::tissue::cycle_budget_test {
namespace {

solver::NewtonReport took(int iterations, int halvings = 0) {
  solver::NewtonReport report;
  report.iterations = iterations;
  report.halvings = halvings;
  return report;
}

TEST(CycleBudget, IsThatOfSolvesTrialsAndStages) {
  FemSettings settings;
  settings.max_newton_iterations = 10;
  CycleBudget budget(settings, 1);
  budget.beginCycle();
  budget.beginTrial();
  EXPECT_EQ(budget.left(), 40);
  EXPECT_EQ(budget.ofNextSolve(false), 10);
  budget.beginStage();
  EXPECT_EQ(budget.left(), 44);
  EXPECT_EQ(budget.ofNextSolve(true), 4);
  budget.spend(took(38));
  EXPECT_EQ(budget.ofNextSolve(false), 6);
  budget.spend(took(8));
  EXPECT_EQ(budget.left(), -2);
  EXPECT_EQ(budget.ofNextSolve(false), 1);
  budget.beginTrial();
  EXPECT_EQ(budget.left(), 8);
  budget.beginCycle();
  budget.beginTrial();
  EXPECT_EQ(budget.left(), 40);
}

TEST(CycleBudget, CountsTrialsOfLineSearchesAsPartsOfAnIteration) {
  FemSettings settings;
  settings.max_newton_iterations = 10;
  CycleBudget budget(settings, 1), of_cheap(settings, 4);
  for (CycleBudget* one : {&budget, &of_cheap}) {
    one->beginCycle();
    one->beginTrial();
    one->spend(took(8, 5));
    one->spend(took(8, 12));
  }
  EXPECT_EQ(budget.left(), 40 - 16 - 2);
  EXPECT_EQ(of_cheap.left(), 40 - 4 - 2);
}

TEST(CycleBudget, IsNoLimitForACaseThatHasToConverge) {
  FemSettings settings;
  settings.only_converged = true;
  CycleBudget budget(settings, 1);
  budget.beginCycle();
  budget.beginTrial();
  budget.spend(took(100000, 100000));
  EXPECT_EQ(budget.left(), settings.max_newton_iterations);
}

// A tool that leaps deep into tissue in every cycle, with iterations that are far too few.
TEST(CycleBudget, BoundsWhatCyclesTakeThatDoNotConverge) {
  test::Slab slab(Eigen::Vector3i(6, 6, 3));
  slab.settings.max_newton_iterations = 2;
  const auto tissue = slab.make();
  const instrument::Geometry ball = instrument::Sphere{0.01};
  bool failed = false;
  for (int k = 0; k < 20; ++k) {
    const auto at = [](int n) {
      return poseFromXyzRpy(Vec3(0.05, 0.05, n % 2 == 0 ? 0.06 : 0.02), Vec3::Zero());
    };
    const TissueStep& step = tissue->step({{&ball, 0, at(k), at(k + 1)}}, test::kStep);
    failed = failed || step.status == solver::SolveStatus::kIterationLimit;
    // Each stage may take one more than it has, to follow the tools, and each search one.
    const int stages = step.sweep_stages;
    EXPECT_LE(step.newton_iterations, 2 * (4 + 3) + 4 * (4 + 5) * stages) << k;
    ASSERT_TRUE(tissue->positions().allFinite());
  }
  EXPECT_TRUE(failed);
}

}  // namespace
}  // namespace palpate::tissue::cycle_budget_test
