// SPDX-License-Identifier: GPL-3.0-or-later
// Shipped scenes that no other test replays to the end: every cycle converges, and the tool is
// felt.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "sim/shipped_replay.h"

namespace palpate::sim::shipped_trajectories_test {
namespace {

struct Motion {
  std::string scene, trajectory;
  double least, most;  // of its largest force [N]
};

class ShippedTrajectories : public ::testing::TestWithParam<Motion> {};
INSTANTIATE_TEST_SUITE_P(Scenes, ShippedTrajectories,
                         ::testing::Values(Motion{"kidney_grasper", "", 0.1, 5.0},
                                           Motion{"needle_insertion", "", 1.0, 1.5},
                                           Motion{"gallbladder_tf", "", 0.05, 2.0},
                                           Motion{"gallbladder_full", "", 0.1, 5.0},
                                           Motion{"interface_2011_fine", "interface_2011", 0.05,
                                                  5.0}),
                         [](const auto& motion) { return motion.param.scene; });

TEST_P(ShippedTrajectories, TouchConvergeAndLetGo) {
  test::ShippedReplay replay(GetParam().scene, GetParam().trajectory);
  double force = 0.0;
  const StepResult& last = replay.to(1e3, [&](const StepResult& result) {
    for (const InstrumentResult& tool : result.instruments) {
      force = std::max(force, tool.spatial.force.norm());
    }
  });
  std::printf("largest force %.3f N\n", force);
  EXPECT_GT(force, GetParam().least);
  EXPECT_LT(force, GetParam().most);
  for (const InstrumentResult& tool : last.instruments) {
    EXPECT_EQ(tool.spatial.force.norm(), 0.0) << "it has let go";
  }
}

}  // namespace
}  // namespace palpate::sim::shipped_trajectories_test
