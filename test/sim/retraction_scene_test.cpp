// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped retractor holds the lobe of the liver up while the probe presses below.
#include <algorithm>

#include "shipped_replay.h"

namespace palpate::sim::retraction_scene_test {
namespace {

// Times of the shipped trajectory [s]: lifted, probe before it touches, first and second palpation
// held, probe away again, fan below the lobe, end.
constexpr double kLifted = 3.4, kBefore = 4.4, kFirst = 5.4, kSecond = 7.2, kAfter = 9.0,
                 kLowered = 10.6, kEnd = 12.4;
constexpr double kRelaxed = 0.45;  // of the stress of config/materials/liver.yaml, after long

TEST(RetractionScene, HoldsTheLobeWhileTheProbePalpates) {
  test::ShippedReplay replay("liver_retraction");
  const Simulator& simulator = replay.simulator();
  Eigen::Index edge = 0;
  const Points rest = simulator.cells(0).points;
  rest.row(0).maxCoeff(&edge);

  double touched = 0.0, most = 0.0;  // the fan's height when it first touched [m], force [N]
  const auto look = [&](const StepResult& result) {
    const InstrumentResult& fan = result.instruments[0];
    if (touched == 0.0 && fan.contacts > 0) touched = fan.X_WC.translation().z();
    most = std::max(most, fan.spatial.force.norm());
  };
  const StepResult& step = replay.to(kLifted, look);
  const auto& fan = step.instruments[0];
  const auto& probe = step.instruments[1];
  const double way = fan.X_WC.translation().z() - touched;
  const auto lift = [&] { return simulator.positions(0)(2, edge) - rest(2, edge); };
  EXPECT_GT(way, 0.010);
  EXPECT_GE(lift(), 0.8 * way);

  replay.to(kBefore, look);
  const double load = -fan.spatial.force.z();
  std::printf("edge lifted by %.1f mm, fan by %.1f; load at most %.3f N, then %.3f N\n",
              1e3 * lift(), 1e3 * way, most, load);
  EXPECT_GE(fan.spatial.force.norm(), kRelaxed * most);
  EXPECT_EQ(probe.contacts, 0);

  // The deeper palpation meets more; the lobe, which is not let down, is carried by both.
  double before = 0.0;
  for (const double t : {kFirst, kSecond}) {
    replay.to(t, look);
    const double pressed = probe.spatial.force.norm(), carried = -fan.spatial.force.z();
    std::printf("at %.1f s probe %.3f N, fan %.3f N\n", t, pressed, carried);
    EXPECT_GT(pressed, before);
    EXPECT_LT(probe.spatial.force.z(), 0.0);
    EXPECT_GT(carried, 0.1 * load);
    EXPECT_GE(carried - probe.spatial.force.z(), kRelaxed * load);
    EXPECT_GE(lift(), 0.8 * way);
    before = pressed;
  }
  EXPECT_GT(before, 0.1);

  replay.to(kAfter, look);
  EXPECT_EQ(probe.contacts, 0);
  EXPECT_GE(-fan.spatial.force.z(), kRelaxed * load);
  EXPECT_LT(most, 2.0);  // a bar of 6 cm, 4.5 cm thick and 5.8 kPa, bent by 3 cm: 1.1 N

  replay.to(kLowered);
  replay.to(kEnd, [](const StepResult& result) {
    for (const InstrumentResult& tool : result.instruments) {
      EXPECT_EQ(tool.contacts, 0);
      EXPECT_EQ(tool.spatial.force.norm(), 0.0);
    }
  });
}

}  // namespace
}  // namespace palpate::sim::retraction_scene_test
