// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "palpate/sim/simulator.h"
#include "slab_scene.h"
#include "support/allocations.h"

namespace palpate::sim {
namespace {

using test::SlabScene;

// A tool presses, and presses again: what the first press needed is there for the second.
class NoAllocation : public ::testing::TestWithParam<bool> {};

TEST_P(NoAllocation, InACycleOnceItHasSeenOneLikeIt) {
  SlabScene slab;
  scene::Scene scene = slab.scene();
  scene.instruments[0].proxy.active = GetParam();
  Simulator simulator(scene);
  std::vector<std::vector<LinkPoses>> poses;
  for (const Eigen::VectorXd& q : SlabScene::press()) {
    poses.push_back({simulator.linkPoses(0, q)});
  }
  int contacts = 0;
  for (const bool counted : {false, true}) {
    simulator.reset();
    simulator.step(poses.front(), 0.01);
    test::countAllocations(counted);
    for (const auto& pose : poses) contacts += simulator.step(pose, 0.01).report.contacts;
    test::countAllocations(false);
  }
  EXPECT_GT(contacts, 0);
  EXPECT_EQ(test::allocations(), 0U) << "in " << poses.size() << " cycles";
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutAProxy, NoAllocation, ::testing::Bool());

}  // namespace
}  // namespace palpate::sim
