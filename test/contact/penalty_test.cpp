// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/penalty.h"

#include <gtest/gtest.h>

namespace palpate::contact {
namespace {

constexpr Penalty kPenalty{3.0e7, 1.0e-4};

TEST(Penalty, IsSilentOutside) {
  for (const double p : {0.0, -1e-9, -1.0}) {
    EXPECT_EQ(kPenalty.energy(p), 0.0);
    EXPECT_EQ(kPenalty.pressure(p), 0.0);
    EXPECT_EQ(kPenalty.slope(p), 0.0);
  }
}

TEST(Penalty, DerivativesAgreeAndJoinSmoothly) {
  constexpr double h = 1e-9;
  for (const double p : {1e-6, 5e-5, 0.99999e-4, 1.00001e-4, 2e-4, 1e-3}) {
    EXPECT_NEAR(kPenalty.pressure(p), (kPenalty.energy(p + h) - kPenalty.energy(p - h)) / (2 * h),
                1e-4 * kPenalty.pressure(p));
    EXPECT_NEAR(kPenalty.slope(p), (kPenalty.pressure(p + h) - kPenalty.pressure(p - h)) / (2 * h),
                1e-4 * kPenalty.stiffness);
  }
}

}  // namespace
}  // namespace palpate::contact
