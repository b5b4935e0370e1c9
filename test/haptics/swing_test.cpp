// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/swing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::haptics::swing_test {
namespace {

TEST(Swing, IsTheWayOfAnOscillation) {
  Swing swing;
  for (double t = 0.0; t < 2.0; t += 1e-3) swing.add(Vec3(0, 0, 2e-3 * std::sin(20.0 * t)));
  EXPECT_NEAR(swing.length(), 4e-3, 1e-5);
  EXPECT_NEAR(swing.range(), 4e-3, 1e-5);
}

TEST(Swing, LeavesCreepOut) {
  Swing swing;
  for (double t = 0.0; t < 2.0; t += 1e-3) swing.add(Vec3(1e-3 * std::exp(-t), 0, -1e-3 * t));
  EXPECT_EQ(swing.length(), 0.0);
  EXPECT_GT(swing.range(), 2e-3);
}

TEST(Swing, SeesAnOscillationOnTopOfCreep) {
  Swing swing;
  for (double t = 0.0; t < 2.0; t += 1e-3) {
    swing.add(Vec3(0, 0, 1e-3 * std::sin(30.0 * t) - 1e-4 * t));
  }
  EXPECT_NEAR(swing.length(), 2e-3, 1e-4);
}

TEST(Swing, IsNothingOfNothing) {
  Swing swing;
  EXPECT_EQ(swing.length(), 0.0);
  swing.add(Vec3(1, 2, 3));
  EXPECT_EQ(swing.length(), 0.0);
}

}  // namespace
}  // namespace palpate::haptics::swing_test
