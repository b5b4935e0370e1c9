// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "support/allocations.h"
#include "two_organs.h"

namespace palpate::tissue {
namespace {

// Of two organs a gap [m] apart, one of them pressed.
void expectNone(const ModelSettings& settings, double gap) {
  const auto tissue = test::makeOrgans(test::twoBlocks(gap), settings);
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

// A group that lasts takes no memory.
TEST(GroupAllocations, AreNoneWhileAGroupLasts) { expectNone(test::organSettings(), 0.005); }

TEST(GroupAllocations, AreNoneWhileOrgansTouch) {
  ModelSettings settings = test::organSettings();
  settings.interactions = interactions();
  expectNone(settings, 0.0005);
}

}  // namespace
}  // namespace palpate::tissue
