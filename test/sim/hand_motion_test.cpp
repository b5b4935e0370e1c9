// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/hand_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace palpate::sim::hand_motion_test {
namespace {

// Velocities are those of the positions, and nothing leaps.
TEST(HandMotion, GoesAsFastAsItSays) {
  for (const std::string& name : HandMotion::names()) {
    HandMotion motion({name, 0.005, 0.006, 0.03});
    constexpr double kStep = 1e-4;
    HandIntent before = motion.at(0.0);
    EXPECT_LT(before.position.norm(), 1e-12) << name;
    int corners = 0;
    for (double t = kStep; t < 4.0; t += kStep) {
      const HandIntent now = motion.at(t);
      const Vec3 v = (now.position - before.position) / kStep;
      EXPECT_LT(v.norm(), 1.0) << name << " " << t;
      corners += (v - 0.5 * (before.velocity + now.velocity)).norm() > 2e-3;
      before = now;
    }
    EXPECT_LE(corners, 2) << name;  // where a way down ends
  }
}

TEST(HandMotion, GoesToTheDepth) {
  EXPECT_DOUBLE_EQ(HandMotion({"press", 0.005, 0.006, 0.03}).at(9.0).position.z(), -0.011);
  EXPECT_DOUBLE_EQ(HandMotion({"taps", 0.005, 0.006, 0.03}).at(0.25).position.z(), -0.011);
  EXPECT_DOUBLE_EQ(HandMotion({"slide", 0.005, 0.006, 0.03}).at(9.0).position.x(), 0.02);
  HandMotion wander({"wander", 0.005, 0.006, 0.03});
  double low = 0.0, high = -1.0;
  for (double t = 0.0; t < 200.0; t += 0.01) {
    const Vec3 p = wander.at(t).position;
    low = std::min(low, p.z());
    high = std::max(high, p.z());
    EXPECT_LE(p.head<2>().cwiseAbs().maxCoeff(), 0.02);
  }
  EXPECT_LT(low, -0.012);
  EXPECT_EQ(high, 0.0);
}

TEST(HandMotion, RefusesWhatIsNone) {
  EXPECT_THROW(HandMotion({"jump", 0.005, 0.004, 0.03}), std::invalid_argument);
  EXPECT_THROW(HandMotion({"press", 0.005, 0.004, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::sim::hand_motion_test
