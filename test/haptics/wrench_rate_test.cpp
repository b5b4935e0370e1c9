// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/wrench_rate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "palpate/haptics/body_wrench.h"

namespace palpate::haptics::wrench_rate_test {
namespace {

constexpr double kTick = 1.0e-3;

WrenchFilterSettings limits() {
  WrenchFilterSettings settings;
  settings.max_force_rate = 100.0;
  settings.max_torque_rate = 10.0;
  return settings;
}

TEST(WrenchRate, TurnsNoFasterThanItMayWhenAFrameLeaps) {
  WrenchRate rate(limits());
  const Wrench world{Vec3(0.0, 0.0, 2.0), Vec3(0.3, 0.0, 0.0)};
  for (int k = 0; k < 100; ++k) rate.follow(world, kTick);
  EXPECT_TRUE(rate.output().force.isApprox(world.force, 1e-12));
  const Mat3 R = Eigen::AngleAxisd(M_PI, Vec3::UnitY()).toRotationMatrix();
  const Wrench turned = bodyWrench(world, R);
  int ticks = 0;
  for (Wrench last = rate.output(); !rate.output().force.isApprox(turned.force, 1e-12); ++ticks) {
    const Wrench& now = rate.follow(turned, kTick);
    ASSERT_LE((now.force - last.force).norm(), 100.0 * kTick * (1 + 1e-12));
    ASSERT_LE((now.torque - last.torque).norm(), 10.0 * kTick * (1 + 1e-12));
    ASSERT_LE(now.force.norm(), world.force.norm() * (1 + 1e-12));
    ASSERT_LT(ticks, 100);
    last = now;
  }
  EXPECT_EQ(ticks, 40);  // 4 N
}

TEST(WrenchRate, FollowsAHandThatTurnsAtOnceAndGoesToZero) {
  WrenchRate rate(limits());
  const Wrench world{Vec3(0.0, 0.0, 2.0), Vec3::Zero()};
  for (int k = 0; k < 200; ++k) {  // at 20 rad/s it needs 40 N/s
    const Mat3 R = Eigen::AngleAxisd(20.0 * k * kTick, Vec3::UnitX()).toRotationMatrix();
    const Wrench goal = bodyWrench(world, R);
    const Wrench& now = rate.follow(goal, kTick);
    ASSERT_TRUE(k <= 40 || now.force.isApprox(goal.force, 1e-12)) << k;
  }
  for (int k = 0; k < 30; ++k) rate.follow(Wrench(), kTick);
  EXPECT_EQ(rate.output().force, Vec3::Zero());
}

TEST(WrenchRate, ALateTickIsNoLeap) {
  WrenchRate rate(limits());
  rate.follow({Vec3(20.0, 0.0, 0.0), Vec3::Zero()}, 5.0);
  EXPECT_NEAR(rate.output().force.x(), 100.0 * limits().max_step, 1e-12);
  rate.follow(Wrench(), std::nan(""));
  EXPECT_NEAR(rate.output().force.x(), 100.0 * limits().max_step, 1e-12);
}

TEST(WrenchRate, RefusesRatesThatAreNone) {
  WrenchFilterSettings none = limits();
  none.max_torque_rate = 0.0;
  EXPECT_THROW(WrenchRate{none}, std::invalid_argument);
}

}  // namespace
}  // namespace palpate::haptics::wrench_rate_test
