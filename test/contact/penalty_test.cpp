// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/penalty.h"

#include <gtest/gtest.h>

namespace palpate::contact::penalty_test {
namespace {

constexpr Penalty kPenalty{3.0e7, 1.0e-4};
constexpr double kRadius = 2.0e-3;

TEST(Penalty, IsSilentOutside) {
  for (const double p : {0.0, -1e-9, -1.0}) {
    EXPECT_EQ(kPenalty.energy(p, kRadius), 0.0);
    EXPECT_EQ(kPenalty.pressure(p, kRadius), 0.0);
    EXPECT_EQ(kPenalty.slope(p, kRadius), 0.0);
  }
}

TEST(Penalty, DerivativesAgreeAndJoinSmoothly) {
  constexpr double h = 1e-9;
  for (const double p : {1e-6, 5e-5, 0.99999e-4, 1.00001e-4, 2e-4, 1e-3}) {
    EXPECT_NEAR(kPenalty.pressure(p, kRadius),
                (kPenalty.energy(p + h, kRadius) - kPenalty.energy(p - h, kRadius)) / (2 * h),
                1e-4 * kPenalty.pressure(p, kRadius));
    EXPECT_NEAR(kPenalty.slope(p, kRadius),
                (kPenalty.pressure(p + h, kRadius) - kPenalty.pressure(p - h, kRadius)) / (2 * h),
                1e-4 * kPenalty.stiffness);
  }
}

TEST(Penalty, HardensTowardsTheMiddleOfTheBodyOnly) {
  constexpr Penalty kSharp{3.0e7, 1.0e-9};
  const double shallow = kSharp.pressure(kRadius / 40.0, kRadius);
  EXPECT_NEAR(shallow, kSharp.pressure(kRadius / 40.0, 1.0), 0.01 * shallow);
  EXPECT_GT(kSharp.pressure(kRadius, kRadius), 500.0 * kSharp.pressure(kRadius, 1.0));
}

}  // namespace
}  // namespace palpate::contact::penalty_test
