// SPDX-License-Identifier: GPL-3.0-or-later
// What a hand feels of bone, through its device.
#include <gtest/gtest.h>

#include <algorithm>

#include "anatomy_scene.h"
#include "palpate/haptics/swing.h"
#include "palpate/sim/hand_loop.h"

namespace palpate::sim::hand_on_bone_test {
namespace {

struct Held {
  double swing = 0.0, least = 1e9, most = 0.0;       // of the last second [m], [N]
  double bone = 0.0, rendered = 0.0, deepest = 0.0;  // stiffness [N/m], of the hand [m]
};

// A hand means to be 8 mm below the top of a plate of bone, gets there at 30 mm/s and stays; no
// organ is near.
class HandOnBone : public ::testing::Test {
 protected:
  HandOnBone() : scene(files.scene(test::AnatomyScene::bone("plate.obj", "[0.5, 0, 0.05]"))) {
    scene.instruments[0].proxy.active = true;
  }

  Held hold(const HandLoopSettings& settings, double push, double slide = 0.0) const {
    Simulator simulator(scene);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
    q[0] = 0.45;
    q[2] = -0.04;  // the ball of 5 mm is 5 mm above
    HandLoop loop(&simulator, 0, simulator.linkPoses(0, q), settings);
    Held held;
    haptics::Swing swing;
    constexpr double kSeconds = 8.0;
    for (double t = 0.0; t < kSeconds;) {
      HandIntent intent;
      intent.position = Vec3(slide * t, 0.0, -std::min(0.03 * t, 0.013));
      intent.velocity = Vec3(slide, 0.0, 0.03 * t < 0.013 ? -0.03 : 0.0);
      intent.push.z() = -push;
      const HandTick& tick = loop.tick(intent);
      t = tick.time;
      if (t < kSeconds - 1.0) continue;
      swing.add(Vec3(0.0, 0.0, tick.position.z()));
      held.deepest = std::max(held.deepest, -0.005 - tick.position.z());
      held.least = std::min(held.least, tick.force.norm());
      held.most = std::max(held.most, tick.force.norm());
      held.bone = std::max(held.bone, tick.tissue_stiffness);
      held.rendered = std::max(held.rendered, tick.stiffness);
    }
    held.swing = swing.length();
    return held;
  }

  static HandLoopSettings held(double grip, double delay) {
    HandLoopSettings settings;
    settings.hand = {0.1, 0.5, grip, 0.01 * grip, 5.5e-5, 0.0, 0.0};
    if (grip == 0.0) settings.hand.guide_stiffness = 100.0, settings.hand.guide_damping = 1.0;
    settings.delay_in = settings.delay_out = delay;
    settings.told.damping = 0.5;
    settings.told.delay = 2.0 * delay;
    return settings;
  }

  test::AnatomyScene files;
  scene::Scene scene;
};

// As on tissue that is too stiff to render, within 0.2 mm.
TEST_F(HandOnBone, RestsInEveryHandAndBehindAnyDelayThatIsTold) {
  for (const double grip : {0.0, 100.0, 1000.0}) {
    for (const double delay : {0.0, 0.003, 0.01}) {
      const HandLoopSettings settings = held(grip, delay);
      const Held h = hold(settings, grip > 0.0 ? 0.0 : 0.5);
      EXPECT_LT(h.swing, 2e-4) << grip << " N/m, " << delay << " s";
      EXPECT_GT(h.least, 0.05) << grip << " N/m, " << delay << " s";
      // It learns the spring's stiffness or, where the hand hardly moves on it, less; but no less
      // than the device can render, so that the device decides what is felt.
      const double limit = haptics::DeviceLimits(settings.told, settings.tick).maxStiffness();
      EXPECT_LT(h.bone, 1.01 * scene.anatomy[0].felt_stiffness);
      EXPECT_GT(h.bone, limit);
      EXPECT_LT(h.rendered, 1.3 * limit);
      std::cout << grip << " N/m, " << delay << " s: " << h.least << " .. " << h.most << " N, bone "
                << h.bone << " N/m felt as " << h.rendered << ", swing " << 1e3 * h.swing
                << " mm\n";
    }
  }
}

TEST_F(HandOnBone, SlidesWithoutLeaps) {
  const Held h = hold(held(1000.0, 0.003), 0.0, 0.01);
  EXPECT_LT(h.swing, 2e-4);
  EXPECT_GT(h.least, 0.5 * h.most);
}

}  // namespace
}  // namespace palpate::sim::hand_on_bone_test
