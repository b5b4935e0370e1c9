// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "anatomy_scene.h"
#include "palpate/base/latest_value.h"
#include "palpate/haptics/tool_renderer.h"
#include "palpate/sim/simulator.h"
#include "support/allocations.h"
#include "support/learned_box.h"

namespace palpate::sim {
namespace {

using test::SlabScene;

// The slab of `scene` is pressed twice; what the first time needed is there for the second.
void pressTwice(const scene::Scene& scene) {
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

// A tool presses, and presses again: what the first press needed is there for the second. On its
// way up it grazes bone.
class NoAllocation : public ::testing::TestWithParam<bool> {};

TEST_P(NoAllocation, InACycleOnceItHasSeenOneLikeIt) {
  test::AnatomyScene slab;
  scene::Scene scene = slab.scene(test::AnatomyScene::bone("plate.obj", "[0.112, 0, 0.065]"));
  scene.instruments[0].proxy.active = GetParam();
  Simulator simulator(scene);
  std::vector<std::vector<LinkPoses>> poses;
  for (const Eigen::VectorXd& q : SlabScene::press()) {
    poses.push_back({simulator.linkPoses(0, q)});
  }
  int contacts = 0, on_bone = 0;
  for (const bool counted : {false, true}) {
    simulator.reset();
    simulator.step(poses.front(), 0.01);
    test::countAllocations(counted);
    for (const auto& pose : poses) {
      const StepResult& result = simulator.step(pose, 0.01);
      contacts += result.report.contacts;
      for (const ContactPoint& c : result.contacts) on_bone += c.organ == ContactPoint::kNone;
    }
    test::countAllocations(false);
  }
  EXPECT_GT(contacts, on_bone);
  EXPECT_GT(on_bone, 0);
  EXPECT_EQ(test::allocations(), 0U) << "in " << poses.size() << " cycles";
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutAProxy, NoAllocation, ::testing::Bool());

// Nor where the slab is of springs, in explicit steps.
TEST(NoAllocationOfSprings, InACycleOnceItHasSeenOneLikeIt) {
  SlabScene slab;
  scene::Scene scene = slab.scene();
  scene.organs[0].model = "mass_spring";
  scene.organs[0].damping.mass = 20.0;
  scene.organs[0].springs.scheme = "symplectic_euler";
  scene.organs[0].springs.region = 0.03;
  pressTwice(scene);
}

// Nor where it is of cells, exact ones, of which cycles fail here, or some of them left out.
class NoAllocationOfCells : public ::testing::TestWithParam<const char*> {};

TEST_P(NoAllocationOfCells, InACycleOnceItHasSeenOneLikeIt) {
  SlabScene slab;
  scene::Scene scene = slab.scene();
  scene.organs[0].model = "honeycomb";
  scene.organs[0].honeycomb.volume = GetParam();
  scene.organs[0].honeycomb.cut_off = scene.organs[0].honeycomb.volume == "exact" ? 0.0 : 1e-5;
  scene.organs[0].honeycomb.max_sweeps = 20;
  pressTwice(scene);
}

INSTANTIATE_TEST_SUITE_P(Volumes, NoAllocationOfCells, ::testing::Values("linear", "exact"));

// Nor where a part of it is linear and solved for beforehand, in both ways to join the parts.
TEST(NoAllocationOfHybrids, InACycleOnceItHasSeenOneLikeIt) {
  for (const char* exchange : {"monolithic", "loop"}) {
    SlabScene slab;
    scene::Scene scene = slab.scene();
    scene.organs[0].model = "hybrid";
    scene.organs[0].damping = {20.0, 0.0};
    scene.organs[0].hybrid.exchange = exchange;
    scene.organs[0].material.density = 1e5;  // the loop is stable
    scene.gravity.setZero();
    scene.organs[0].hybrid.region = mesh::BoxRegion{Vec3::Constant(-1.0), Vec3(0.05, 1.0, 1.0)};
    pressTwice(scene);
  }
}

// Nor where it is its surface alone.
TEST(NoAllocationOfBoundaryElements, InACycleOnceItHasSeenOneLikeIt) {
  SlabScene slab;
  scene::Scene scene = slab.scene();
  scene.organs[0].model = "bem";
  pressTwice(scene);
}

// Nor where it carries a fine surface that learned.
TEST(NoAllocationOfEnriched, InACycleOnceItHasSeenOneLikeIt) {
  for (const char* detail : {"residual", "displacement"}) {
    SlabScene slab;
    scene::Scene scene = slab.scene();
    test::beEnriched(detail, &scene);
    pressTwice(scene);
  }
}

// Nor where it is as it learned, and of finite elements beyond.
TEST(NoAllocationOfNeural, InACycleOnceItHasSeenOneLikeIt) {
  SlabScene slab;
  const test::LearnedBox learned = test::learnedSlab();
  scene::Scene scene = slab.scene();
  scene.organs[0].model = "neural";
  scene.organs[0].neural.file = learned.file();
  pressTwice(scene);
}

// Nor where it is a sheet, laid flat or rolled up.
TEST(NoAllocationOfCloth, InACycleOnceItHasSeenOneLikeIt) {
  for (const char* scheme : {"implicit", "symplectic_euler"}) {
    for (const bool rolled : {false, true}) {
      SlabScene slab;
      scene::Scene scene = slab.scene();
      test::beASheet(scheme, rolled, &scene);
      pressTwice(scene);
    }
  }
}

// Nor where the slab breathes on springs, and is glued to something that breathes.
TEST(NoAllocationOfSurroundings, InACycleOnceItHasSeenOneLikeIt) {
  SlabScene slab;
  scene::Scene scene = slab.scene();
  scene::SupportConfig& glue = scene.organs[0].supports[0];
  glue.motion.emplace();
  glue.motion->amplitude = Vec3(0.0, 0.0, 0.002);
  scene::SupportConfig springs = glue;
  springs.kind = "springs";
  springs.springs = {2.0e5, 1.0e5, 20.0, 20.0};
  glue.select = mesh::BoxRegion{Vec3::Constant(-1.0), Vec3(0.02, 1.0, 1e-6)};
  scene.organs[0].supports.push_back(springs);
  scene.organs[0].pressure.emplace_back();
  scene.organs[0].pressure[0].pressure = 50.0;
  scene.organs[0].pressure[0].select = mesh::PlaneRegion{0, 0.0};
  pressTwice(scene);
}

// Nor between the solve and the hand, from the first solve on.
TEST(NoAllocationOfTheForce, BetweenASolveAndTheHand) {
  haptics::DeviceSettings device;
  device.delay = 0.006;
  haptics::ToolRenderer tool({}, device, 1e-3);
  haptics::ForceRenderer force({}, {}, device, 1e-3);
  LatestValue<haptics::RenderTarget> handed_over;
  double most = 0.0;
  test::countAllocations(true);
  for (int cycle = 0; cycle < 200; ++cycle) {
    const Vec3 hand(0.0, 1e-5 * cycle, 0.002 - 1e-4 * (cycle % 100));
    const Vec3 to = tool.target(hand);
    Wrench wrench;
    wrench.force.z() = std::max(0.0, -2000.0 * to.z());
    handed_over.write(cycle % 50 == 49 ? tool.lose() : tool.observe(to, to, wrench, 0.01));
    for (int tick = 0; tick < 10; ++tick) {
      most = std::max(most, force.update(handed_over.read(), hand, 1e-3).force.norm());
    }
  }
  test::countAllocations(false);
  EXPECT_GT(most, 0.1);
  EXPECT_EQ(test::allocations(), 0U);
}

}  // namespace
}  // namespace palpate::sim
