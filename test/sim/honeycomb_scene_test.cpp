// SPDX-License-Identifier: GPL-3.0-or-later
// The shipped block of cells is pressed and dragged, and comes back.
#include "shipped_replay.h"

namespace palpate::sim::honeycomb_scene_test {
namespace {

// Times of the shipped trajectory [s]: before the touch, pressed, dragged, away, end.
constexpr double kBefore = 1.0, kPressed = 2.2, kDragged = 3.8, kEnd = 6.0;

TEST(HoneycombScene, IsPressedDraggedAndLetGo) {
  test::ShippedReplay replay("honeycomb");
  EXPECT_EQ(replay.simulator().cells(0).numCells(), 300);
  EXPECT_EQ(replay.to(kBefore).report.contacts, 0);
  const Points begin = replay.simulator().positions(0);

  const Vec3 pressed = replay.to(kPressed).instruments[0].spatial.force;
  EXPECT_GT(pressed.z(), 0.1);
  EXPECT_LT(pressed.head<2>().norm(), 1e-2 * pressed.z());
  const Vec3 dragged = replay.to(kDragged).instruments[0].spatial.force;
  EXPECT_LT(dragged.x(), -0.1 * dragged.z());
  EXPECT_GE(dragged.x(), -0.8 * 1.001 * dragged.norm());
  std::printf("pressed %.3f N, dragged %.3f N aside and %.3f N up\n", pressed.z(), -dragged.x(),
              dragged.z());
  replay.to(kEnd, [](const StepResult& result) {
    if (result.instruments[0].contacts == 0) {
      EXPECT_EQ(result.instruments[0].spatial.force.norm(), 0.0);
    }
  });
  EXPECT_LT((replay.simulator().positions(0) - begin).cwiseAbs().maxCoeff(), 2e-5);
}

}  // namespace
}  // namespace palpate::sim::honeycomb_scene_test
