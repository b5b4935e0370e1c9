// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/velocity_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::haptics::velocity_estimate_test {
namespace {

constexpr double kTick = 1e-3, kStep = 5.5e-5;

Vec3 quantised(double z) { return Vec3(0, 0, kStep * std::round(z / kStep)); }

TEST(VelocityEstimate, FollowsAMotionThatIsQuantisedAndReportedSeldom) {
  for (const int every : {1, 10}) {
    VelocityEstimate velocity;
    Vec3 reported = Vec3::Zero();
    for (int k = 0; k < 300; ++k) {
      if (k % every == 0) reported = quantised(0.05 * kTick * k);
      velocity.update(reported, kTick);
      if (k > 50) {
        EXPECT_NEAR(velocity.velocity().z(), 0.05, 0.012) << k << " " << every;
      }
    }
  }
}

TEST(VelocityEstimate, ComesToRest) {
  VelocityEstimate velocity;
  for (int k = 0; k < 100; ++k) velocity.update(Vec3(0, 0, 1e-4 * k), kTick);
  for (int k = 0; k < 100; ++k) velocity.update(Vec3(0, 0, 1e-2), kTick);
  EXPECT_LT(velocity.velocity().norm(), 1e-6);
}

// After a rest, too, however long it was.
TEST(VelocityEstimate, ALeapIsNoVelocity) {
  VelocityEstimate velocity;
  for (int k = 0; k < 1000; ++k) velocity.update(Vec3::Zero(), kTick);
  velocity.update(Vec3(0.05, 0, 0), kTick);
  EXPECT_EQ(velocity.velocity(), Vec3::Zero());
  EXPECT_EQ(velocity.sinceLeap(), 0.0);
  velocity.update(Vec3(0.05, 0, 0), kTick);
  EXPECT_EQ(velocity.sinceLeap(), kTick);
}

}  // namespace
}  // namespace palpate::haptics::velocity_estimate_test
