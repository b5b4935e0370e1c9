// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/wrench_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace palpate::haptics::wrench_filter_test {
namespace {

constexpr double kDt = 1e-3;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

Wrench pushing(double fz, double tx = 0.0) { return {Vec3(0, 0, fz), Vec3(tx, 0, 0)}; }

Wrench run(WrenchFilter* filter, const Wrench& target, bool live, int cycles) {
  for (int i = 0; i < cycles; ++i) filter->update(target, live, kDt);
  return filter->output();
}

TEST(WrenchFilter, StartsAtZeroAndReachesTheTargetExactlyAfterTheRamp) {
  WrenchFilter filter;
  EXPECT_TRUE(filter.output().force.isZero(0));
  run(&filter, pushing(2.0, 0.1), true, 50);
  EXPECT_NEAR(filter.output().force.z(), 1.0, 1e-9);  // half of the ramp of 0.1 s
  run(&filter, pushing(2.0, 0.1), true, 51);
  EXPECT_EQ(filter.output().force.z(), 2.0);
  EXPECT_EQ(filter.output().torque.x(), 0.1);
}

TEST(WrenchFilter, FadesTheLastTargetToExactlyZeroAndComesBack) {
  WrenchFilter filter;
  run(&filter, pushing(2.0, 0.1), true, 200);
  EXPECT_NEAR(run(&filter, pushing(9.0), false, 50).force.z(), 1.0, 1e-9);
  run(&filter, pushing(9.0), false, 51);
  EXPECT_TRUE(filter.output().force.isZero(0));
  EXPECT_TRUE(filter.output().torque.isZero(0));
  EXPECT_NEAR(run(&filter, pushing(4.0), true, 50).force.z(), 2.0, 1e-9);
}

TEST(WrenchFilter, SaturatesTheNormAndKeepsTheDirection) {
  WrenchFilterSettings s;
  s.max_force = 5.0;
  s.max_torque = 0.5;
  WrenchFilter filter(s);
  const Wrench big{Vec3(30, 40, 0), Vec3(0, -3, 4)};
  run(&filter, big, true, 500);
  EXPECT_NEAR((filter.output().force - Vec3(3, 4, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((filter.output().torque - Vec3(0, -0.3, 0.4)).norm(), 0.0, 1e-12);
}

TEST(WrenchFilter, LimitsTheRateOfForceAndTorque) {
  WrenchFilterSettings s;
  s.ramp = 0.0;
  s.max_force_rate = 100.0;
  s.max_torque_rate = 10.0;
  WrenchFilter filter(s);
  EXPECT_NEAR(run(&filter, pushing(10.0, 1.0), true, 1).force.z(), 0.1, 1e-12);
  EXPECT_NEAR(filter.output().torque.x(), 0.01, 1e-12);
  run(&filter, pushing(10.0, 1.0), true, 99);
  EXPECT_NEAR(filter.output().force.z(), 10.0, 1e-9);
  EXPECT_NEAR(run(&filter, pushing(-10.0), true, 1).force.z(), 9.9, 1e-9);
}

TEST(WrenchFilter, LowPassFollowsAnExponential) {
  WrenchFilterSettings s;
  s.ramp = 0.0;
  s.smoothing = 0.02;
  s.max_force_rate = 1e9;
  WrenchFilter filter(s);
  run(&filter, pushing(1.0), true, 1);  // the first live value is taken as it is
  EXPECT_EQ(filter.output().force.z(), 1.0);
  run(&filter, pushing(3.0), true, 20);
  EXPECT_NEAR(filter.output().force.z(), 3.0 - 2.0 * std::exp(-1.0), 1e-9);
}

TEST(WrenchFilter, BadTargetCountsAsNotLive) {
  for (const double bad : {kNaN, kInf, -kInf}) {
    WrenchFilter filter;
    run(&filter, pushing(2.0), true, 200);
    EXPECT_NEAR(run(&filter, pushing(bad), true, 50).force.z(), 1.0, 1e-9);
    EXPECT_TRUE(run(&filter, pushing(2.0, bad), true, 51).force.isZero(0));
    EXPECT_EQ(run(&filter, pushing(2.0), true, 101).force.z(), 2.0);
  }
}

TEST(WrenchFilter, BadTimeStepLeavesTheOutputAndALateCallIsNoJump) {
  WrenchFilter filter;
  run(&filter, pushing(2.0), true, 200);
  for (const double bad : {0.0, -1.0, kNaN, kInf}) {
    EXPECT_EQ(filter.update(pushing(-2.0), true, bad).force.z(), 2.0);
  }
  WrenchFilterSettings s;
  s.ramp = 0.0;
  s.max_force_rate = 100.0;
  s.max_step = 0.01;
  WrenchFilter late(s);
  EXPECT_NEAR(late.update(pushing(10.0), true, 5.0).force.z(), 1.0, 1e-12);
}

TEST(WrenchFilter, AnyInputStaysFiniteAndWithinTheLimits) {
  WrenchFilterSettings s;
  s.smoothing = 0.005;
  WrenchFilter filter(s);
  std::mt19937 rng(7);
  const double values[] = {0, 1, -3, 40, 1e308, -1e308, 1e-308, kNaN, kInf};
  const double steps[] = {1e-3, 1e-4, 0.5, 0, kNaN};
  const auto any = [&] { return values[rng() % 9]; };
  for (int i = 0; i < 20000; ++i) {
    const Vec3 before = filter.output().force;
    const Wrench target{Vec3(any(), any(), any()), Vec3(any(), any(), any())};
    const Wrench& out = filter.update(target, rng() % 3 != 0, steps[rng() % 5]);
    ASSERT_TRUE(out.allFinite()) << i;
    ASSERT_LE(out.force.norm(), s.max_force * (1 + 1e-12));
    ASSERT_LE(out.torque.norm(), s.max_torque * (1 + 1e-12));
    ASSERT_LE((out.force - before).norm(), s.max_force_rate * s.max_step * (1 + 1e-12));
  }
}

TEST(WrenchFilter, RefusesSettingsThatCannotBe) {
  for (const double bad : {0.0, -1.0, kNaN, kInf}) {
    WrenchFilterSettings s;
    s.max_force = bad;
    EXPECT_THROW(WrenchFilter{s}, std::invalid_argument) << bad;
  }
  WrenchFilterSettings s;
  s.ramp = -0.1;
  EXPECT_THROW(WrenchFilter{s}, std::invalid_argument);
}

TEST(WrenchFilter, ResetIsZeroAtOnce) {
  WrenchFilter filter;
  run(&filter, pushing(2.0), true, 200);
  filter.reset();
  EXPECT_TRUE(filter.output().force.isZero(0));
  EXPECT_EQ(filter.gain(), 0.0);
}

}  // namespace
}  // namespace palpate::haptics::wrench_filter_test
