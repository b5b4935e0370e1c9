// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/hand_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "palpate/haptics/swing.h"
#include "slab_scene.h"

namespace palpate::sim::hand_loop_test {
namespace {

// What comes of the last second.
struct Held {
  double swing = 0.0, least = 1e9, most = 0.0;  // [m], [N]
  double stiffness = 0.0, energy_out = 0.0;     // as rendered [N/m], [J]
};

// A hand means to be 8 mm below the top of a slab of about 400 N/m, gets there at 30 mm/s and
// stays.
class HandOnSlab : public ::testing::Test {
 protected:
  HandOnSlab() : scene(slab.scene("gravity: [0, 0, 0]\ncontact: {stiffness: 3.0e8}\n")) {
    scene.instruments[0].proxy.active = true;
  }
  /// A block of some 3e4 N/m.
  static scene::Scene stiff(scene::Scene scene) {
    scene.organs[0].material.constants["young_modulus"] = {2.0e6};
    scene.contact.stiffness = 1.0e11;
    return scene;
  }

  static Held hold(const scene::Scene& scene, const HandLoopSettings& settings, double push = 0.0,
                   double seconds = 4.0) {
    Simulator simulator(scene);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
    q[2] = -0.05;  // 5 mm above the slab
    HandLoop loop(&simulator, 0, simulator.linkPoses(0, q), settings);
    Held held;
    haptics::Swing swing;
    for (double t = 0.0; t < seconds;) {
      HandIntent intent;
      intent.position.z() = -std::min(0.03 * t, 0.013);
      intent.velocity.z() = 0.03 * t < 0.013 ? -0.03 : 0.0;
      intent.push.z() = -push;
      const HandTick& tick = loop.tick(intent);
      t = tick.time;
      if (t < seconds - 1.0) continue;
      swing.add(tick.position);
      held.least = std::min(held.least, tick.force.norm());
      held.most = std::max(held.most, tick.force.norm());
      held.stiffness = std::max(held.stiffness, tick.stiffness);
    }
    held.swing = swing.length();
    held.energy_out = loop.passivity().largestOut();
    return held;
  }

  test::SlabScene slab;
  scene::Scene scene;
};

HandLoopSettings light(bool local_model) {
  HandLoopSettings settings;
  settings.local_model = local_model;
  if (!local_model) {  // as the node had it
    settings.filter.smoothing = 0.005;
    settings.passivity.max_damping = 0.0;
  }
  return settings;
}

// 100 g on 100 N/m: what swung up when the last wrench was held.
TEST_F(HandOnSlab, RestsWithALocalModelWhereAHeldWrenchSwingsUp) {
  const Held with = hold(scene, light(true)), without = hold(scene, light(false));
  EXPECT_LT(with.swing, 2e-4);
  EXPECT_GT(with.least, 0.2);
  EXPECT_GT(without.swing, 5e-3);
}

HandLoopSettings held(double mass, double grip, double damping, double delay) {
  HandLoopSettings settings;
  settings.hand = {mass, damping, grip, 0.01 * grip, 5.5e-5, 0.0, 0.0};
  if (grip == 0.0) settings.hand.guide_stiffness = 100.0, settings.hand.guide_damping = 1.0;
  settings.delay_in = settings.delay_out = delay;
  settings.told.damping = damping;
  settings.told.delay = 2.0 * delay;
  return settings;
}

// A sampled spring K asks for a damping of K (delay + 1.5 ticks) [Colgate, Schenkel 1997]: with 20
// ms of delay some 9 N s/m here, which no device has. Limp hands lean on it with half a newton.
TEST_F(HandOnSlab, RestsInEveryHandAndBehindAnyDelayThatIsTold) {
  for (const double grip : {0.0, 100.0, 1000.0}) {
    for (const double mass : {0.045, 0.1, 0.3}) {
      for (const double delay : {0.0, 0.003, 0.01}) {
        const Held h = hold(scene, held(mass, grip, 0.5, delay), grip > 0.0 ? 0.0 : 0.5, 8.0);
        EXPECT_LT(h.swing, 2e-4) << grip << " N/m, " << mass << " kg, " << delay << " s";
        EXPECT_GT(h.least, 0.01);
      }
    }
  }
}

TEST_F(HandOnSlab, SwingsBehindADelayThatNobodyTold) {
  HandLoopSettings settings = held(0.1, 100.0, 0.5, 0.01);
  settings.told = {};
  EXPECT_GT(hold(scene, settings).swing, 1e-3);
}

// Nearly as stiff as bone: felt as stiff as the device can render.
TEST_F(HandOnSlab, RestsOnABlockThatIsTooStiffToRender) {
  const scene::Scene block = stiff(scene);
  for (const double grip : {0.0, 100.0, 1000.0}) {
    for (const double delay : {0.0, 0.003, 0.01}) {
      const HandLoopSettings settings = held(0.1, grip, 0.5, delay);
      const Held h = hold(block, settings, grip > 0.0 ? 0.0 : 0.5, 8.0);
      const double limit = haptics::DeviceLimits(settings.told, settings.tick).maxStiffness();
      EXPECT_LT(h.swing, 2e-4) << grip << " N/m, " << delay << " s";
      EXPECT_LT(h.stiffness, 1.3 * limit);
      EXPECT_GT(h.least, 0.01);
    }
  }
}

// 50 g that mean to be nowhere and weigh half a newton: they bounce, and each bounce gives a
// little.
TEST_F(HandOnSlab, ALimpHandComesToRest) {
  const Held h = hold(scene, held(0.05, 0.0, 0.1, 0.0), 0.5);
  EXPECT_LT(h.swing, 2e-4);
  EXPECT_LT(h.energy_out, 1e-3);
}

// A light hand wanders through the tissue and out of it, as it likes, for ten minutes.
TEST_F(HandOnSlab, LittleEnergyComesOutOfRandomMotions) {
  Simulator simulator(scene);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  q[2] = -0.05;
  HandLoop loop(&simulator, 0, simulator.linkPoses(0, q), light(true));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> pick(-1.0, 1.0);
  Vec3 from = Vec3::Zero(), to = from;
  double begin = 0.0, duration = 0.0;
  for (double t = 0.0; t < 600.0;) {
    if (t >= begin + duration) {
      begin += duration;
      duration = 0.6 + 0.4 * pick(random);
      from = to;
      to = Vec3(0.02 * pick(random), 0.02 * pick(random), -0.006 + 0.008 * pick(random));
    }
    const double s = (t - begin) / duration;
    HandIntent intent;
    intent.position = from + s * s * (3.0 - 2.0 * s) * (to - from);
    intent.velocity = 6.0 * s * (1.0 - s) / duration * (to - from);
    t = loop.tick(intent).time;
  }
  EXPECT_LT(loop.passivity().largestOut(), 1e-3);
}

TEST_F(HandOnSlab, GivesTheSameBitsAgain) {
  const Held one = hold(scene, light(true), 0.0, 1.5), other = hold(scene, light(true), 0.0, 1.5);
  EXPECT_EQ(one.swing, other.swing);
  EXPECT_EQ(one.most, other.most);
}

}  // namespace
}  // namespace palpate::sim::hand_loop_test
