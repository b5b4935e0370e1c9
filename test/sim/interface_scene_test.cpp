// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped livers of the published interface: a segment presses, goes about and leaves.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shipped_replay.h"
#include "slab_scene.h"
#include "support/input_error.h"

namespace palpate::sim::interface_scene_test {
namespace {

// Times of the shipped trajectory [s]: before the touch, pressed, gone about, away.
constexpr double kBefore = 0.5, kPressed = 1.4, kGone = 2.7, kEnd = 3.5;

// The source's 146 tetrahedra and its at most 500 vertices, within a twentieth.
TEST(InterfaceScene, HasAboutThePublishedSizes) {
  const auto sizeOf = [](const std::string& name) {
    const Simulator simulator(
        scene::readScene(test::sourceFolder() + "/config/scenes/" + name + ".yaml"));
    return std::make_pair(simulator.cells(0).numCells(), simulator.positions(0).cols());
  };
  EXPECT_NEAR(static_cast<double>(sizeOf("interface_2011").first), 146.0, 0.05 * 146.0);
  EXPECT_NEAR(static_cast<double>(sizeOf("interface_2011_fine").second), 500.0, 0.05 * 500.0);
}

class InterfaceScenes : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Livers, InterfaceScenes,
                         ::testing::Values("interface_2011", "interface_2011_fine"),
                         [](const auto& of) { return of.param; });

TEST_P(InterfaceScenes, PushBackAndLetGo) {
  test::ShippedReplay replay(GetParam(), "interface_2011");
  EXPECT_EQ(replay.to(kBefore).report.contacts, 0);
  const Points begin = replay.simulator().positions(0);
  Vec3 last = Vec3::Zero();
  double roughest = 0.0;
  const auto look = [&](const StepResult& result) {
    const InstrumentResult& tool = result.instruments[0];
    EXPECT_LE(tool.contacts, 1);
    if (tool.contacts == 0) {
      EXPECT_EQ(tool.spatial.force.norm(), 0.0);
    }
    roughest = std::max(roughest, (tool.spatial.force - last).norm());
    last = tool.spatial.force;
  };
  const Vec3 pressed = replay.to(kPressed, look).instruments[0].spatial.force;
  const Vec3 gone = replay.to(kGone, look).instruments[0].spatial.force;
  std::printf("%s: %.3f N pressed, %.3f N after it went about\n", GetParam().c_str(),
              pressed.norm(), gone.norm());
  EXPECT_GT(pressed.z(), 0.5 * pressed.norm());
  EXPECT_GT(gone.z(), 0.5 * gone.norm());
  replay.to(kEnd, look);
  EXPECT_LT((replay.simulator().positions(0) - begin).cwiseAbs().maxCoeff(), 1e-4);
  // The tool goes 25 mm in 0.8 s, no faster than 0.6 mm a cycle, of 10 mm that it is in: a force
  // that jumps changes by more than a quarter of what it is.
  EXPECT_LT(roughest, 0.25 * std::max(pressed.norm(), gone.norm()));
}

TEST(InterfaceScene, GoesOnMidContactFromItsState) {
  const std::string config = test::sourceFolder() + "/config/";
  const std::string rows = config + "trajectories/interface_2011.csv";
  const scene::Scene scene = scene::readScene(config + "scenes/interface_2011.yaml");
  const formats::Trajectory trajectory = formats::readTrajectory(rows);
  Simulator one(scene), other(scene);
  const auto go = [&](Simulator* simulator, std::size_t begin, std::size_t end) {
    std::vector<Wrench> wrenches;
    for (std::size_t k = begin; k < end; ++k) {
      const Eigen::VectorXd q = trajectory.values.col(static_cast<Eigen::Index>(k));
      wrenches.push_back(
          simulator->step({simulator->linkPoses(0, q)}, 0.01).instruments[0].spatial);
    }
    return wrenches;
  };
  go(&one, 0, 180);
  other.restore(one.state());
  const std::vector<Wrench> here = go(&one, 180, 330), there = go(&other, 180, 330);
  double largest = 0.0;
  for (std::size_t k = 0; k < here.size(); ++k) {
    EXPECT_EQ(here[k].force, there[k].force) << k;
    EXPECT_EQ(here[k].torque, there[k].torque) << k;
    largest = std::max(largest, here[k].force.norm());
  }
  EXPECT_GT(largest, 0.5);
}

TEST(InterfaceScene, RefusesAToolThatIsNoSegment) {
  const test::SlabScene slab;
  scene::Scene scene =
      slab.scene("solver: {method: newton_bicgstab}\ncontact: {model: prescribed}\n");
  EXPECT_TRUE(test::hasProblem(test::problemsOf([&] { const Simulator simulator(scene); }),
                               "instruments[0].urdf", "must be one cylinder"));
}

}  // namespace
}  // namespace palpate::sim::interface_scene_test
