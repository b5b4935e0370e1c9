// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/silence_guard.h"

#include <gtest/gtest.h>

#include <limits>

namespace palpate::haptics {
namespace {

constexpr double kPatience = 0.05, kRamp = 0.02, kTick = 0.002;

const Wrench kHeard{Vec3(1.0, -2.0, 3.0), Vec3(0.1, 0.0, 0.0)};

TEST(SilenceGuard, SaysNothingWhileItHears) {
  SilenceGuard guard(kPatience, kRamp);
  for (int k = 0; k < 1000; ++k) {
    EXPECT_TRUE(guard.hear(kHeard));
    for (int n = 0; n < 20; ++n) EXPECT_FALSE(guard.pass(kTick));
  }
}

TEST(SilenceGuard, TakesTheWrenchBackInARampAndKeepsItAtZero) {
  SilenceGuard guard(kPatience, kRamp);
  guard.hear(kHeard);
  double silence = 0.0, last = kHeard.force.norm();
  while (!guard.pass(kTick)) silence += kTick;
  EXPECT_NEAR(silence, kPatience, 1.5 * kTick);
  for (int k = 1; k <= 30; ++k) {
    const double force = guard.output().force.norm();
    EXPECT_LE(last - force, kHeard.force.norm() * kTick / kRamp + 1e-12);
    EXPECT_TRUE(k < 10 ? force > 0.0 : force < 1e-12) << k;
    if (k > 10) {
      EXPECT_EQ(force, 0.0) << k;
    }
    last = force;
    EXPECT_TRUE(guard.pass(kTick));
  }
  EXPECT_EQ(guard.output().torque, Vec3::Zero());
}

TEST(SilenceGuard, BeforeAnythingIsHeardItSaysZero) {
  SilenceGuard guard(kPatience, kRamp);
  while (!guard.pass(kTick)) {
  }
  EXPECT_EQ(guard.output().force, Vec3::Zero());
}

TEST(SilenceGuard, HearsAgain) {
  SilenceGuard guard(kPatience, kRamp);
  guard.hear(kHeard);
  for (int k = 0; k < 100; ++k) guard.pass(kTick);
  EXPECT_TRUE(guard.silent());
  guard.hear(2.0 * kHeard);
  EXPECT_FALSE(guard.silent());
  EXPECT_FALSE(guard.pass(kTick));
  for (int k = 0; k < 30; ++k) guard.pass(kTick);
  EXPECT_GT(guard.output().force.norm(), 0.0);  // from what was heard last
  EXPECT_LE(guard.output().force.norm(), 2.0 * kHeard.force.norm());
}

TEST(SilenceGuard, WhatIsNotFiniteIsSilence) {
  SilenceGuard guard(kPatience, kRamp);
  guard.hear(kHeard);
  Wrench bad = kHeard;
  bad.torque.y() = std::numeric_limits<double>::quiet_NaN();
  for (int k = 0; k < 100; ++k) {
    EXPECT_FALSE(guard.hear(bad));
    guard.pass(kTick);
  }
  EXPECT_EQ(guard.output().force, Vec3::Zero());
}

}  // namespace
}  // namespace palpate::haptics
