// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/hand_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "slab_scene.h"

namespace palpate::sim {
namespace {

// A hand means to be 8 mm below the top of a slab of about 400 N/m, gets there at 30 mm/s and
// stays.
struct Held {
  double swing = 0.0, least = 1e9, most = 0.0;  // of the last second [m], [N]
};

class HandOnSlab : public ::testing::Test {
 protected:
  HandOnSlab() {
    scene = slab.scene("gravity: [0, 0, 0]\ncontact: {stiffness: 3.0e8}\n");
    scene.instruments[0].proxy.active = true;
  }

  Held hold(const HandLoopSettings& settings, double seconds = 4.0) const {
    Simulator simulator(scene);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
    q[2] = -0.05;  // 5 mm above the slab
    HandLoop loop(&simulator, 0, simulator.linkPoses(0, q), settings);
    Held held;
    Vec3 low = Vec3::Constant(1.0), high = -low;
    for (double t = 0.0; t < seconds;) {
      HandIntent intent;
      intent.position.z() = -std::min(0.03 * t, 0.013);
      intent.velocity.z() = 0.03 * t < 0.013 ? -0.03 : 0.0;
      const HandTick& tick = loop.tick(intent);
      t = tick.time;
      if (t < seconds - 1.0) continue;
      low = low.cwiseMin(tick.position);
      high = high.cwiseMax(tick.position);
      held.least = std::min(held.least, tick.force.norm());
      held.most = std::max(held.most, tick.force.norm());
    }
    held.swing = (high - low).norm();
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
  const Held with = hold(light(true)), without = hold(light(false));
  EXPECT_LT(with.swing, 2e-4);
  EXPECT_GT(with.least, 0.2);
  EXPECT_GT(without.swing, 5e-3);
}

// A sampled spring K asks for a damping of K (delay + 1.5 ticks) [Colgate, Schenkel 1997]: with 6
// ms of delay some 2 N s/m, which the limp hand has not.
TEST_F(HandOnSlab, RestsInEveryHandThatHasTheDampingForItsDelay) {
  for (const double stiffness : {0.0, 100.0, 300.0, 1000.0, 2000.0}) {
    for (const double mass : {0.045, 0.1, 0.3}) {
      for (const double delay : {0.0, 0.003}) {
        if (stiffness == 0.0 && delay > 0.0) continue;
        HandLoopSettings settings = light(true);
        settings.hand.mass = mass;
        settings.hand.grip_stiffness = std::max(stiffness, 30.0);  // a limp one still hangs on
        settings.hand.grip_damping = 0.01 * settings.hand.grip_stiffness;
        settings.hand.device_damping = 0.5;
        settings.delay_in = settings.delay_out = delay;
        EXPECT_LT(hold(settings).swing, 2e-4)
            << stiffness << " N/m, " << mass << " kg, " << delay << " s";
      }
    }
  }
}

// 50 g that mean to be nowhere and weigh half a newton: they bounce, and each bounce gives a
// little.
TEST_F(HandOnSlab, ALimpHandComesToRestWhereEnergyIsTakenBack) {
  for (const double damping : {0.0, 2.0}) {
    HandLoopSettings settings = light(true);
    settings.passivity.max_damping = damping;
    settings.hand = {0.05, 0.1, 0.0, 0.0, 5.5e-5};
    Simulator simulator(scene);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
    q[2] = -0.05;
    HandLoop loop(&simulator, 0, simulator.linkPoses(0, q), settings);
    HandIntent intent;
    intent.push.z() = -0.5;
    double low = 1.0, high = -1.0;
    for (double t = 0.0; t < 4.0;) {
      const HandTick& tick = loop.tick(intent);
      t = tick.time;
      if (t < 3.0) continue;
      low = std::min(low, tick.position.z());
      high = std::max(high, tick.position.z());
    }
    if (damping > 0.0) {
      EXPECT_LT(high - low, 2e-4);
      EXPECT_LT(loop.passivity().largestOut(), 2e-3);
    } else {
      EXPECT_GT(high - low, 2e-4);
    }
  }
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
  const Held one = hold(light(true), 1.5), other = hold(light(true), 1.5);
  EXPECT_EQ(one.swing, other.swing);
  EXPECT_EQ(one.most, other.most);
}

}  // namespace
}  // namespace palpate::sim
