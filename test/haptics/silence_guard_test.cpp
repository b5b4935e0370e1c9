// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/silence_guard.h"

#include <gtest/gtest.h>

#include <limits>

namespace palpate::haptics::silence_guard_test {
namespace {

constexpr double kPatience = 0.05, kRamp = 0.02, kTick = 0.002;

const Wrench kHeard{Vec3(1.0, -2.0, 3.0), Vec3(0.1, 0.0, 0.0)};

WrenchFilterSettings limits() {
  WrenchFilterSettings settings;
  settings.ramp = kRamp;
  return settings;
}

class SilenceGuardTest : public ::testing::Test {
 protected:
  /// Hears the wrench until it is all there.
  void come(const Wrench& wrench) {
    for (int k = 0; k < 20; ++k) guard_.hear(wrench, kTick);
    ASSERT_TRUE(guard_.output().force.isApprox(wrench.force, 1e-12));
  }
  double force() const { return guard_.output().force.norm(); }

  SilenceGuard guard_{kPatience, limits()};
};

TEST_F(SilenceGuardTest, SaysNothingWhileItHears) {
  come(kHeard);
  for (int k = 0; k < 1000; ++k) {
    EXPECT_TRUE(guard_.hear(kHeard, kTick));
    EXPECT_TRUE(guard_.output().force.isApprox(kHeard.force, 1e-12));
    for (int n = 0; n < 20; ++n) EXPECT_FALSE(guard_.pass(kTick));
  }
}

TEST_F(SilenceGuardTest, TakesTheWrenchBackInARampAndKeepsItAtZero) {
  come(kHeard);
  double silence = 0.0, last = kHeard.force.norm();
  while (!guard_.pass(kTick)) silence += kTick;
  EXPECT_NEAR(silence, kPatience, 1.5 * kTick);
  for (int k = 1; k <= 30; ++k) {
    EXPECT_LE(last - force(), kHeard.force.norm() * kTick / kRamp + 1e-12);
    EXPECT_TRUE(k < 10 ? force() > 0.0 : force() < 1e-12) << k;
    if (k > 10) {
      EXPECT_EQ(force(), 0.0) << k;
    }
    last = force();
    EXPECT_TRUE(guard_.pass(kTick));
  }
  EXPECT_EQ(guard_.output().torque, Vec3::Zero());
}

TEST_F(SilenceGuardTest, BeforeAnythingIsHeardItSaysZero) {
  while (!guard_.pass(kTick)) {
  }
  EXPECT_EQ(force(), 0.0);
}

TEST_F(SilenceGuardTest, WhoIsHeardAgainComesByTheRamp) {
  come(kHeard);
  for (int k = 0; k < 100; ++k) guard_.pass(kTick);
  EXPECT_TRUE(guard_.silent());
  EXPECT_EQ(force(), 0.0);
  for (double last = 0.0; force() < 0.999 * kHeard.force.norm(); last = force()) {
    EXPECT_TRUE(guard_.hear(kHeard, kTick));
    EXPECT_FALSE(guard_.silent());
    ASSERT_GT(force(), last);
    ASSERT_LE(force() - last, kHeard.force.norm() * kTick / kRamp + 1e-12);
    EXPECT_FALSE(guard_.pass(0.0));
  }
}

// A process that was stopped finds another wrench than it left.
TEST_F(SilenceGuardTest, ItsOwnAbsenceIsNoLeap) {
  come(kHeard);
  const Wrench other{Vec3(-20.0, 0.0, 0.0), Vec3::Zero()};
  for (Vec3 last = guard_.output().force; last != other.force; last = guard_.output().force) {
    guard_.hear(other, 5.0);
    ASSERT_LE((guard_.output().force - last).norm(), 2000.0 * 0.01 * (1 + 1e-12));
    ASSERT_NE(guard_.output().force, last);
  }
}

TEST_F(SilenceGuardTest, NobodyIsPassedOnBeyondTheLimits) {
  const Wrench huge{Vec3(1.0e300, -1.0e300, 0.0), Vec3(0.0, 0.0, 1.0e9)};
  for (int k = 0; k < 100; ++k) {
    guard_.hear(k % 2 ? huge : -1.0 * huge, kTick);
    ASSERT_LE(force(), 20.0 * (1 + 1e-12));
    ASSERT_LE(guard_.output().torque.norm(), 2.0 * (1 + 1e-12));
  }
}

TEST_F(SilenceGuardTest, WhatIsNotFiniteIsSilence) {
  come(kHeard);
  Wrench bad = kHeard;
  bad.torque.y() = std::numeric_limits<double>::quiet_NaN();
  for (int k = 0; k < 100; ++k) {
    EXPECT_FALSE(guard_.hear(bad, kTick));
    guard_.pass(kTick);
  }
  EXPECT_EQ(force(), 0.0);
}

}  // namespace
}  // namespace palpate::haptics::silence_guard_test
