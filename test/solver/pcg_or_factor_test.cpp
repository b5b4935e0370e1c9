// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/pcg_or_factor.h"

#include <gtest/gtest.h>

#include "half_stiff_block.h"
#include "palpate/base/state_bytes.h"

namespace palpate::solver::pcg_or_factor_test {
namespace {

constexpr int kMostIterations = 500;
constexpr double kTolerance = 1e-6;

using test::hard;
using test::mild;

// Whether the mild system is solved by iterations, with the bits of BlockPcg alone, and no factor.
bool iterates(PcgOrFactor* solver) {
  Points x, y;
  EXPECT_EQ(solver->solve(mild().A, mild().b, kTolerance, &x).status, SolveStatus::kConverged);
  EXPECT_LT(mild().residual(x), 2.0 * kTolerance);
  BlockPcg(kMostIterations).solve(mild().A, mild().b, kTolerance, &y);
  return x == y;
}

// Solves until a factor does.
void failOnce(PcgOrFactor* solver) {
  Points x;
  int most = 20;
  while (solver->solve(hard().A, hard().b, kTolerance, &x).status != SolveStatus::kConverged) {
    ASSERT_GT(--most, 0);
  }
  EXPECT_LT(hard().residual(x), kTolerance);
}

TEST(PcgOrFactor, FindsWhatIterationsDoNot) {
  Points x;
  EXPECT_EQ(BlockPcg(kMostIterations).solve(hard().A, hard().b, kTolerance, &x).status,
            SolveStatus::kIterationLimit);
  PcgOrFactor solver{BlockPcg(kMostIterations)};
  failOnce(&solver);
  EXPECT_EQ(solver.solve(hard().A, hard().b, kTolerance, &x).status, SolveStatus::kConverged);
}

TEST(PcgOrFactor, HasTheBitsOfIterationsWhereTheseDo) {
  PcgOrFactor solver{BlockPcg(kMostIterations)};
  for (int cycle = 0; cycle < 3; ++cycle) {
    solver.beginCycle(0.01);
    EXPECT_TRUE(iterates(&solver));
  }
}

TEST(PcgOrFactor, TriesIterationsAgainAfterTwiceAsManyCycles) {
  PcgOrFactor solver{BlockPcg(kMostIterations)};
  for (const int cycles : {1, 2, 4}) {
    solver.beginCycle(0.01);
    failOnce(&solver);
    for (int k = 0; k < cycles; ++k) {
      solver.beginCycle(0.01);
      EXPECT_FALSE(iterates(&solver));
    }
  }
  for (int k = 0; k < 2; ++k) {
    solver.beginCycle(0.01);
    EXPECT_TRUE(iterates(&solver));
  }
  solver.beginCycle(0.01);
  failOnce(&solver);
  solver.beginCycle(0.01);
  EXPECT_FALSE(iterates(&solver));
  solver.beginCycle(0.01);
  EXPECT_TRUE(iterates(&solver));
}

// What iterations were told of what has changed since the factor's matrix is not what has since
// theirs.
TEST(PcgOrFactor, TakesAllOfAMatrixAfterAFactor) {
  PcgOrFactor solver{BlockPcg(kMostIterations)};
  solver.beginCycle(0.01);
  failOnce(&solver);
  solver.beginCycle(0.01);
  EXPECT_FALSE(iterates(&solver));
  solver.beginCycle(0.01);
  const std::vector<int> none;
  solver.onlyChanged(none);
  EXPECT_TRUE(iterates(&solver));
}

// Where a matrix is indefinite indeed, what iterations found before they knew is a way down.
TEST(PcgOrFactor, TakesTheWayDownThatIterationsFoundBeforeACurvatureThatIsNegative) {
  fem::Stiffness indefinite = mild().A;
  indefinite.blocks().block(indefinite.blocks().diagonal(100)) *= 0.1;
  PcgOrFactor solver{BlockPcg(kMostIterations)};
  Points x, y;
  const LinearReport report = BlockPcg(kMostIterations).solve(indefinite, mild().b, kTolerance, &x);
  ASSERT_EQ(report.status, SolveStatus::kIterationLimit);
  ASSERT_GT(report.iterations, 0);
  EXPECT_FALSE(report.in_vain);
  for (int again = 0; again < 200; ++again) {
    ASSERT_EQ(solver.solve(indefinite, mild().b, kTolerance, &y).iterations, report.iterations);
  }
  EXPECT_EQ(x, y);
}

TEST(PcgOrFactor, FindsNothingThatIsNotThere) {
  fem::Stiffness indefinite = hard().A;
  indefinite.blocks().block(indefinite.blocks().diagonal(100)).diagonal().array() -= 1e3;
  PcgOrFactor solver{BlockPcg(kMostIterations)};
  failOnce(&solver);
  Points x;
  EXPECT_EQ(solver.solve(indefinite, hard().b, kTolerance, &x).status,
            SolveStatus::kNotPositiveDefinite);
}

TEST(PcgOrFactor, GoesOnFromWhatItSaved) {
  PcgOrFactor solver{BlockPcg(kMostIterations)}, other{BlockPcg(kMostIterations)};
  for (const int cycles : {1, 2}) {
    solver.beginCycle(0.01);
    failOnce(&solver);
    for (int k = 0; k < cycles; ++k) solver.beginCycle(0.01);
  }
  StateWriter out;
  solver.save(&out);
  StateReader in(out.bytes());
  other.restore(&in);
  EXPECT_FALSE(iterates(&other));
  other.beginCycle(0.01);
  failOnce(&other);
  for (int k = 0; k < 4; ++k) {
    other.beginCycle(0.01);
    EXPECT_FALSE(iterates(&other));
  }
  other.restart();
  EXPECT_TRUE(iterates(&other));
}

}  // namespace
}  // namespace palpate::solver::pcg_or_factor_test
