// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/blas_speed.h"

#include <gtest/gtest.h>

#include "support/contains.h"

namespace palpate::solver::blas_speed_test {
namespace {

using test::contains;

TEST(BlasWarning, SaysNothingOfAFastOrAnUnknownBlas) {
  EXPECT_EQ(blasWarning({90e9, 108e9}, nullptr), "");
  EXPECT_EQ(blasWarning({0.351 * 108e9, 108e9}, nullptr), "");
  EXPECT_EQ(blasWarning({0.0, 108e9}, nullptr), "");
  EXPECT_EQ(blasWarning({1e9, 0.0}, nullptr), "");
}

TEST(BlasWarning, NamesTheLikelyCause) {
  const std::string unset = blasWarning({19.8e9, 108e9}, nullptr);
  EXPECT_TRUE(contains(unset, "at 19.8 of 108 Gflop/s")) << unset;
  EXPECT_TRUE(contains(unset, "set OPENBLAS_CORETYPE (SKYLAKEX"));
  const std::string wrong = blasWarning({19.8e9, 108e9}, "PRESCOTT");
  EXPECT_TRUE(contains(wrong, "OPENBLAS_CORETYPE is PRESCOTT"));
}

TEST(BlasSpeed, IsMeasuredHereAndBelievable) {
  const BlasSpeed speed = measureBlasSpeed();
#if defined(__x86_64__)
  ASSERT_TRUE(speed.known());
  EXPECT_GT(speed.dgemm, 1e8);
  EXPECT_GT(speed.peak, 1e9);
  EXPECT_LT(speed.peak, 1e12);
#if !defined(__SANITIZE_ADDRESS__)           // slows the loop down that finds the peak
  EXPECT_LT(speed.dgemm, 2.0 * speed.peak);  // one may have been disturbed
#endif
#else
  EXPECT_FALSE(speed.known());
#endif
}

}  // namespace
}  // namespace palpate::solver::blas_speed_test
