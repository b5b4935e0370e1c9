// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/wrench_fade.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::haptics::wrench_fade_test {
namespace {

const Wrench kPush{Vec3(0.1, -0.0, 1.0 / 3.0), Vec3(0.01, 0, 0)};

TEST(WrenchFade, WhatIsThereComesBackBitForBit) {
  WrenchFade fade(0.1, 1.0);
  const Wrench out = fade.update(kPush, true, 0.01);
  EXPECT_EQ(out.force, kPush.force);
  EXPECT_EQ(out.torque, kPush.torque);
  EXPECT_TRUE(std::signbit(out.force.y()));
}

TEST(WrenchFade, GoesLinearlyToZeroAndComesBackTheSameWay) {
  WrenchFade fade(0.1, 1.0);
  fade.update(kPush, true, 0.01);
  for (int k = 1; k <= 10; ++k) {
    const Wrench out = fade.update({Vec3(9, 9, 9), Vec3(9, 9, 9)}, false, 0.01);
    EXPECT_NEAR((out.force - (1.0 - 0.1 * k) * kPush.force).norm(), 0.0, 1e-12) << k;
    EXPECT_NEAR((out.torque - (1.0 - 0.1 * k) * kPush.torque).norm(), 0.0, 1e-12) << k;
    EXPECT_EQ(fade.held().force, kPush.force);
  }
  EXPECT_NEAR(fade.update(kPush, false, 0.01).force.norm(), 0.0, 1e-12);
  EXPECT_EQ(fade.gain(), 0.0);
  EXPECT_NEAR((fade.update(2.0 * kPush, true, 0.05).force - kPush.force).norm(), 0.0, 1e-12);
}

TEST(WrenchFade, DoesNotDependOnHowTimeIsCut) {
  WrenchFade coarse(0.1, 1.0), fine(0.1, 1.0);
  coarse.update(kPush, true, 0.01);
  fine.update(kPush, true, 0.01);
  for (const bool live : {false, false, true, false, false, true, true, true}) {
    const Wrench at_once = coarse.update(kPush, live, 0.02);
    Wrench bit_by_bit;
    for (int k = 0; k < 20; ++k) bit_by_bit = fine.update(kPush, live, 0.001);
    EXPECT_NEAR((at_once.force - bit_by_bit.force).norm(), 0.0, 1e-12);
  }
}

TEST(WrenchFade, WithoutARampIsThereOrNot) {
  WrenchFade fade(0.0, 0.0);
  EXPECT_EQ(fade.update(kPush, true, 0.001).force, kPush.force);
  EXPECT_TRUE(fade.update(kPush, false, 0.001).force.isZero(0));
}

}  // namespace
}  // namespace palpate::haptics::wrench_fade_test
