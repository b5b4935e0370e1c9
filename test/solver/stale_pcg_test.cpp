// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/stale_pcg.h"

#include <gtest/gtest.h>

#include "half_stiff_block.h"
#include "palpate/base/state_bytes.h"

namespace palpate::solver::stale_pcg_test {
namespace {

using test::HalfStiffBlock;
using test::hard;
using test::mild;

constexpr double kTolerance = 1e-6;

// Iterations.
int solve(StalePcg* solver, const HalfStiffBlock& system) {
  Points x;
  const LinearReport report = solver->solve(system.A, system.b, kTolerance, &x);
  EXPECT_EQ(report.status, SolveStatus::kConverged);
  EXPECT_LT(system.residual(x), 2.0 * kTolerance);
  return report.iterations;
}

void failUntilThereIsAFactor(StalePcg* solver) {
  Points x;
  int most = 20;
  while (solver->solve(hard().A, hard().b, kTolerance, &x).status != SolveStatus::kConverged) {
    ASSERT_GT(--most, 0);
  }
}

TEST(StalePcg, MakesAFactorAtOnceWhereIterationsAreInVain) {
  StalePcg solver(hard().A, 500, false);
  solver.beginCycle(0.01);
  failUntilThereIsAFactor(&solver);
  EXPECT_LE(solve(&solver, hard()), 3);
}

// One that was begun before is not taken into use when it is due.
TEST(StalePcg, KeepsTheYoungestFactor) {
  StalePcg solver(hard().A, 500, false);
  solver.beginCycle(1.0);
  EXPECT_GT(solve(&solver, mild()), 3);  // begins a factor, for the cycle after the next
  failUntilThereIsAFactor(&solver);
  for (int cycle = 0; cycle < 4; ++cycle) {
    solver.beginCycle(1.0);
    EXPECT_LE(solve(&solver, hard()), 3);
  }
}

// Iterations with a factor of no use cost no more than another.
TEST(StalePcg, RenewsAFactorThatIsOfNoUse) {
  StalePcg solver(hard().A, 500, false);
  solver.prepare(mild().A);
  solver.beginCycle(0.01);
  EXPECT_LE(solve(&solver, hard()), 100);
  EXPECT_LE(solve(&solver, hard()), 3);
}

TEST(StalePcg, GoesOnFromWhatItSaved) {
  StalePcg solver(hard().A, 500, false), other(hard().A, 500, false);
  solver.beginCycle(1.0);
  solve(&solver, mild());
  failUntilThereIsAFactor(&solver);
  solver.beginCycle(1.0);
  StateWriter out;
  solver.save(&out);
  StateReader in(out.bytes());
  other.restore(&in);
  for (int cycle = 0; cycle < 4; ++cycle) {
    Points x, y;
    solver.solve(hard().A, hard().b, kTolerance, &x);
    other.solve(hard().A, hard().b, kTolerance, &y);
    EXPECT_EQ(x, y);
    solver.beginCycle(1.0);
    other.beginCycle(1.0);
  }
  EXPECT_LE(solve(&other, hard()), 3);
}

}  // namespace
}  // namespace palpate::solver::stale_pcg_test
