// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/node/step_length.h"

#include <gtest/gtest.h>

#include <random>

namespace palpate::node::step_length_test {
namespace {

constexpr double kPeriod = 0.01;  // [s]

Steady::time_point at(double t) { return Steady::time_point(seconds(t)); }

TEST(StepLength, IsOneCycleWhereStepsBeginInTime) {
  StepLength length(seconds(kPeriod), 5);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter(-0.2 * kPeriod, 0.2 * kPeriod);
  for (int k = 0; k < 1000; ++k) EXPECT_EQ(length.begin(at(k * kPeriod + jitter(random))), 1);
}

// However long steps take, up to the most cycles that one covers.
TEST(StepLength, KeepsSimulatedTimeAtRealTime) {
  for (const double most_late : {1.4, 2.0, 4.3}) {
    StepLength length(seconds(kPeriod), 5);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> late(1.0, most_late);
    double real = 0.0, simulated = kPeriod * length.begin(at(0.0));
    for (int k = 0; k < 1000; ++k) {
      real += kPeriod * late(random);
      simulated += kPeriod * length.begin(at(real));
      EXPECT_NEAR(simulated - kPeriod, real, 0.51 * kPeriod);
    }
  }
}

TEST(StepLength, CoversAtMostSoManyCyclesAndOwesNothingAfterwards) {
  StepLength length(seconds(kPeriod), 5);
  EXPECT_EQ(length.begin(at(0.0)), 1);
  EXPECT_EQ(length.begin(at(1.0)), 5);
  EXPECT_LE(length.begin(at(1.0 + kPeriod)), 2);
  EXPECT_EQ(length.begin(at(1.0 + 2.0 * kPeriod)), 1);
}

TEST(StepLength, OfOneCycleIsAlwaysThat) {
  StepLength length(seconds(kPeriod), 1);
  for (const double t : {0.0, 0.02, 0.5, 0.51, 3.0}) EXPECT_EQ(length.begin(at(t)), 1);
}

TEST(StepLength, DoesNotCountAPause) {
  StepLength length(seconds(kPeriod), 5);
  EXPECT_EQ(length.begin(at(0.0)), 1);
  length.pause();
  EXPECT_EQ(length.begin(at(7.0)), 1);
  EXPECT_EQ(length.begin(at(7.0 + kPeriod)), 1);
}

}  // namespace
}  // namespace palpate::node::step_length_test
