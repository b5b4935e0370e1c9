// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/node/mesh_governor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace palpate::node::mesh_governor_test {
namespace {

struct Ran {
  double coarsening;  // at the end [-]
  double late_share;  // share of the last half of the cycles above two periods [-]
  int changes;        // of the coarsening, in the last half
};

// Cycles whose load is `load` periods times a log-normal scatter, over coarsening^power.
Ran run(double load, double power, double most, int cycles = 4000) {
  MeshGovernor governor(most);
  std::mt19937 random(3);
  std::normal_distribution<double> scatter(0.0, 0.4);
  int late = 0, changes = 0;
  for (int k = 0; k < cycles; ++k) {
    const double before = governor.coarsening();
    const double now = load * std::exp(scatter(random)) / std::pow(before, power);
    governor.observe(now);
    if (2 * k < cycles) continue;
    late += now > 2.0;
    changes += governor.coarsening() != before;
  }
  return {governor.coarsening(), 2.0 * late / cycles, changes};
}

TEST(MeshGovernor, LeavesMeshesAloneWhereCyclesAreInTime) {
  const Ran ran = run(0.6, 1.5, 3.0);
  EXPECT_EQ(ran.coarsening, 1.0);
  EXPECT_EQ(ran.changes, 0);
}

// Coarsening and its neighbours differ by 2^(1/4); the time of cycles by 2^(3/8).
TEST(MeshGovernor, CoarsensUntilOneInTenCyclesIsLate) {
  for (const double load : {3.0, 4.0}) {
    const Ran ran = run(load, 1.5, 10.0);
    EXPECT_GT(ran.coarsening, 1.0) << load;
    EXPECT_NEAR(ran.late_share, 0.1, 0.08) << load;
    EXPECT_LT(ran.changes, 40) << load;  // 2000 cycles are 20 s
  }
}

TEST(MeshGovernor, StaysWithinItsBound) {
  EXPECT_DOUBLE_EQ(run(50.0, 1.5, 3.0).coarsening, 3.0);
  EXPECT_EQ(run(50.0, 1.5, 1.0).coarsening, 1.0);
}

TEST(MeshGovernor, ComesBackSlowerThanItWent) {
  MeshGovernor governor(4.0);
  int up = 0, down = 0;
  while (governor.coarsening() < 2.0) governor.observe(3.0), ++up;
  while (governor.coarsening() > 1.0) governor.observe(0.3), ++down;
  EXPECT_LT(up, 30);  // a third of a second at 100 Hz
  EXPECT_GT(down, 5 * up);
  EXPECT_LT(down, 1000);
}

}  // namespace
}  // namespace palpate::node::mesh_governor_test
