// SPDX-License-Identifier: GPL-3.0-or-later
// Cycles that fail make the wrench fade alike in the live node and in a replay.
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "palpate/haptics/tool_renderer.h"
#include "palpate/scene/hand_settings.h"
#include "palpate/sim/simulator.h"
#include "sim/slab_scene.h"

namespace palpate::node::fading_test {
namespace {

constexpr int kTicks = 10;  // of the force loop in a cycle

/// What the hand feels of a live instrument: the force loop's share of one cycle.
class Hand {
 public:
  explicit Hand(const scene::Scene& scene)
      : tool_(scene.instruments[0].proxy, scene.instruments[0].device, scene.solver.step / kTicks),
        force_(scene::filterSettings(scene, scene.instruments[0]), scene.haptics,
               scene.instruments[0].device, scene.solver.step / kTicks),
        step_(scene.solver.step) {}

  Wrench feel(const sim::StepResult& result) {
    const sim::InstrumentResult& tool = result.instruments[0];
    if (tool.live) p_ = tool.X_WC.translation();
    const haptics::RenderTarget& target =
        tool.live ? tool_.observe(p_, p_, tool.solved, step_) : tool_.lose();
    for (int k = 0; k < kTicks; ++k) force_.update(target, p_, step_ / kTicks);
    return force_.output();
  }

 private:
  haptics::ToolRenderer tool_;
  haptics::ForceRenderer force_;
  double step_;
  Vec3 p_ = Vec3::Zero();
};

class Fading : public ::testing::Test {
 protected:
  Fading() {
    for (int k = 0; k < 60; ++k) cycle(press_[k]);
    for (int k = 0; k < 60; ++k) cycle(press_[60]);  // until the hand's low-pass has come to rest
  }

  const sim::StepResult& cycle(const Eigen::VectorXd& joints) {
    return done(simulator_.step({simulator_.linkPoses(0, joints)}, scene_.solver.step));
  }
  const sim::StepResult& failingCycle() {
    sim::LinkPoses bad = simulator_.linkPoses(0, press_[60]);
    bad[2].translation().x() = std::numeric_limits<double>::quiet_NaN();
    return done(simulator_.step({bad}, scene_.solver.step));
  }
  const sim::StepResult& done(const sim::StepResult& result) {
    live_ = hand_.feel(result);
    replayed_ = result.instruments[0].spatial;
    return result;
  }
  double difference() const {
    return (live_.force - replayed_.force).norm() + (live_.torque - replayed_.torque).norm();
  }

  const test::SlabScene slab_;
  const scene::Scene scene_ = slab_.scene("rates: {ramp: 0.1}\n");
  sim::Simulator simulator_{scene_};
  Hand hand_{scene_};
  const std::vector<Eigen::VectorXd> press_ = test::SlabScene::press();
  Wrench live_, replayed_;
};

TEST_F(Fading, IsTheSameLiveAndReplayed) {
  const double force = replayed_.force.norm();
  ASSERT_GT(force, 0.1);
  ASSERT_LT(difference(), 1e-3 * force);  // the tissue still creeps a little
  for (int k = 1; k <= 12; ++k) {
    const sim::StepResult& failed = failingCycle();
    ASSERT_FALSE(failed.report.usable());
    EXPECT_NEAR(replayed_.force.norm(), std::max(0.0, 1.0 - 0.1 * k) * force, 1e-9) << k;
    EXPECT_LT(difference(), 1e-3 * force) << k;
  }
  EXPECT_EQ(live_.force.norm(), 0.0);
  EXPECT_EQ(replayed_.force.norm(), 0.0);
}

TEST_F(Fading, AndComingBackIsToo) {
  const double force = replayed_.force.norm();
  for (int k = 0; k < 6; ++k) failingCycle();
  for (int k = 0; k < 10; ++k) {
    ASSERT_TRUE(cycle(press_[60]).report.ok());
    EXPECT_LT(difference(), 1e-2 * force) << k;
  }
  EXPECT_NEAR(replayed_.force.norm(), force, 1e-2 * force);
  for (int k = 0; k < 3; ++k) failingCycle();
  EXPECT_NEAR(replayed_.force.norm(), 0.7 * force, 1e-2 * force);
  EXPECT_LT(difference(), 1e-2 * force);
}

}  // namespace
}  // namespace palpate::node::fading_test
