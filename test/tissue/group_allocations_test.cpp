// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "support/allocations.h"
#include "two_organs.h"

namespace palpate::tissue {
namespace {

// A group that lasts takes no memory: two organs that lean on each other, one of them pressed.
TEST(GroupAllocations, AreNoneWhileAGroupLasts) {
  const auto tissue = test::makeOrgans(test::twoBlocks(0.005), test::organSettings());
  double most = 0.0;
  for (const bool counted : {false, true}) {
    tissue->reset();
    for (int k = 0; k < 3; ++k) tissue->step({}, test::kStep);
    std::vector<std::vector<contact::Obstacle>> way;
    test::Balls balls = test::pushRight();
    while (balls.time() < 1.3) way.push_back(balls.next());
    test::countAllocations(counted);
    for (const auto& obstacles : way) {
      tissue->step(obstacles, test::kStep);
      most = std::max(most, (*tissue->reports())[1].interaction_force.norm());
    }
    test::countAllocations(false);
  }
  EXPECT_GT(most, 0.05);
  EXPECT_EQ(test::allocations(), 0U);
}

}  // namespace
}  // namespace palpate::tissue
