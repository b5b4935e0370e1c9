// SPDX-License-Identifier: GPL-3.0-or-later
// What a device can render, against the sampled loop itself: a mass in a hand, felt a delay late.
#include "palpate/haptics/device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <limits>
#include <stdexcept>

#include "palpate/haptics/velocity_estimate.h"

namespace palpate::haptics::device_test {
namespace {

constexpr double kTick = 1e-3;

// What is left of a knock after five seconds.
double left(const DeviceSettings& device, double mass, double grip, double K) {
  const DeviceLimits limits(device, kTick);
  const double lead = limits.lead(K), damping = device.damping + 0.01 * grip;
  VelocityEstimate velocity;
  std::deque<double> forces(static_cast<std::size_t>(std::lround(device.delay / kTick)), 0.0);
  double p = 0.0, v = 0.1, most = 0.0;
  for (int k = 0; k < 5000; ++k) {
    velocity.update(Vec3(0, 0, p), kTick);
    forces.push_back(-K * (p + lead * velocity.velocity().z()));
    const double force = forces.front();
    forces.pop_front();
    for (int s = 0; s < 20; ++s) {
      v += kTick / 20 / mass * (force - grip * p - damping * v);
      p += kTick / 20 * v;
    }
    if (k > 4000) most = std::max(most, std::abs(p));
    if (std::abs(p) > 10.0) return 10.0;
  }
  return most;
}

struct Case {
  double mass, damping, delay;
};
class Rendered : public ::testing::TestWithParam<Case> {
 protected:
  DeviceSettings device() const {
    DeviceSettings d;
    d.mass = GetParam().mass;
    d.damping = GetParam().damping;
    d.delay = GetParam().delay;
    return d;
  }
};

TEST_P(Rendered, TheStiffestSpringComesToRestInEveryHand) {
  const double K = DeviceLimits(device(), kTick).maxStiffness();
  const double at_rest = left(device(), device().mass, 0.0, 1.0);  // next to no spring at all
  for (const double hand : {0.0, 0.05, 0.25}) {
    for (const double grip : {0.0, 30.0, 100.0, 300.0, 1000.0, 2000.0}) {
      EXPECT_LT(left(device(), device().mass + hand, grip, K), std::max(5e-3, at_rest))
          << hand << " kg, " << grip << " N/m";
    }
  }
}

// The limit is half of what is possible, or less.
TEST_P(Rendered, SpringsThatAreMuchStifferDoNot) {
  const double K = 8.0 * DeviceLimits(device(), kTick).maxStiffness();
  EXPECT_GT(left(device(), device().mass, 0.0, K), 1e-2);
}

INSTANTIATE_TEST_SUITE_P(Devices, Rendered,
                         ::testing::Values(Case{0.045, 0.0, 0.0}, Case{0.045, 0.2, 0.006},
                                           Case{0.045, 0.05, 0.02}, Case{0.1, 0.2, 0.006},
                                           Case{0.3, 0.2, 0.02}));

TEST(DeviceLimits, DampingPaysForItsDelayTwice) {
  DeviceSettings device;
  device.damping = 20.0;
  device.delay = 0.02;
  const DeviceLimits limits(device, kTick);
  EXPECT_DOUBLE_EQ(limits.delay(), 0.0215);
  EXPECT_DOUBLE_EQ(limits.maxStiffness() * limits.delay(), 10.0);
  // Enough of its own: the force is for when it arrives, and no more.
  EXPECT_DOUBLE_EQ(limits.lead(limits.maxStiffness()), limits.delay());
  EXPECT_DOUBLE_EQ(limits.lead(0.0), 0.0);
}

TEST(DeviceLimits, ASlowDeviceIsALateOne) {
  DeviceSettings device;
  device.rate = 100.0;
  EXPECT_DOUBLE_EQ(DeviceLimits(device, kTick).delay(), 0.015);
}

TEST(DeviceLimits, RefuseDevicesThatAreNone) {
  DeviceSettings device;
  device.mass = 0.0;
  EXPECT_THROW(DeviceLimits(device, kTick), std::invalid_argument);
  device = {};
  device.delay = -1.0;
  EXPECT_THROW(DeviceLimits(device, kTick), std::invalid_argument);
  device = {};
  device.rate = std::numeric_limits<double>::infinity();
  EXPECT_THROW(DeviceLimits(device, kTick), std::invalid_argument);
  EXPECT_THROW(DeviceLimits({}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::haptics::device_test
