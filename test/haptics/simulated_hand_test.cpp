// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/simulated_hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace palpate::haptics::simulated_hand_test {
namespace {

constexpr double kTick = 1e-3;

// Released 10 mm to the side: the damped oscillation in closed form.
TEST(SimulatedHand, SwingsAsADampedOscillator) {
  HandSettings settings;
  settings.mass = 0.1;
  settings.grip_stiffness = 100.0;
  settings.grip_damping = 0.4;
  settings.device_damping = 0.2;
  SimulatedHand hand(settings, Vec3(0.01, 0.0, 0.0));
  const double decay = (0.4 + 0.2) / (2.0 * 0.1);
  const double omega = std::sqrt(100.0 / 0.1 - decay * decay);
  for (int k = 1; k <= 500; ++k) {
    hand.tick(Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), kTick);
    const double t = kTick * k;
    const double x =
        0.01 * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
    ASSERT_NEAR(hand.position().x(), x, 2e-5) << t;
    ASSERT_EQ(hand.position().y(), 0.0);
  }
}

TEST(SimulatedHand, RestsWhereSpringAndForcesBalance) {
  SimulatedHand hand({}, Vec3::Zero());
  const Vec3 force(0.1, -0.2, 0.5), push(0.0, 0.0, -0.3), meant(0.01, 0.0, 0.0);
  for (int k = 0; k < 5000; ++k) hand.tick(meant, Vec3::Zero(), force, push, kTick);
  const Vec3 rest = meant + (force + push) / HandSettings().grip_stiffness;
  EXPECT_LT((hand.position() - rest).norm(), 1e-9);
  EXPECT_LT(hand.velocity().norm(), 1e-9);
}

TEST(SimulatedHand, FollowsWhereItMeansToBe) {
  SimulatedHand hand({}, Vec3::Zero());
  const Vec3 v(0.0, 0.1, 0.0);
  for (int k = 0; k < 3000; ++k) hand.tick(kTick * k * v, v, Vec3::Zero(), Vec3::Zero(), kTick);
  // The device's damping holds it back.
  const double lag = HandSettings().device_damping * 0.1 / HandSettings().grip_stiffness;
  EXPECT_NEAR(hand.position().y(), 0.3 - lag, 2e-6);
}

TEST(SimulatedHand, MeasuresInSteps) {
  HandSettings settings;
  const SimulatedHand hand(settings, Vec3(1.0e-4, -1.0e-4, 2.0e-5));
  EXPECT_LT((hand.measured() - Vec3(1.1e-4, -1.1e-4, 0.0)).norm(), 1e-12);
  settings.resolution = 0.0;
  EXPECT_EQ(SimulatedHand(settings, Vec3(1e-4, 0, 0)).measured().x(), 1e-4);
}

TEST(SimulatedHand, RefusesWhatIsNone) {
  for (double HandSettings::*value :
       {&HandSettings::mass, &HandSettings::device_damping, &HandSettings::grip_stiffness,
        &HandSettings::grip_damping, &HandSettings::resolution}) {
    HandSettings settings;
    settings.*value = -1.0;
    EXPECT_THROW(SimulatedHand(settings, Vec3::Zero()), std::invalid_argument);
  }
  HandSettings settings;
  settings.mass = 0.0;
  EXPECT_THROW(SimulatedHand(settings, Vec3::Zero()), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::haptics::simulated_hand_test
