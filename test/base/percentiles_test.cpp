// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/percentiles.h"

#include <gtest/gtest.h>

namespace palpate::percentiles_test {
namespace {

TEST(Percentiles, AreZeroWithoutValues) {
  EXPECT_EQ(quantile({}, 0.5), 0.0);
  EXPECT_EQ(percentiles({}).max, 0.0);
}

TEST(Percentiles, NearestRank) {
  EXPECT_EQ(percentiles({3.0}).p50, 3.0);
  EXPECT_EQ(percentiles({3.0}).p99, 3.0);
  std::vector<double> hundred;
  for (int i = 100; i >= 1; --i) hundred.push_back(i);
  const Percentiles p = percentiles(hundred);
  EXPECT_EQ(p.p50, 50.0);
  EXPECT_EQ(p.p99, 99.0);
  EXPECT_EQ(p.max, 100.0);
}

TEST(Percentiles, AreAlwaysOneOfTheValues) {
  const std::vector<double> four = {8.0, 1.0, 4.0, 2.0};
  EXPECT_EQ(quantile(four, 0.0), 1.0);
  EXPECT_EQ(quantile(four, 0.25), 1.0);
  EXPECT_EQ(quantile(four, 0.26), 2.0);
  EXPECT_EQ(quantile(four, 0.5), 2.0);
  EXPECT_EQ(quantile(four, 0.51), 4.0);
  EXPECT_EQ(quantile(four, 1.0), 8.0);
  EXPECT_EQ(quantileOfSorted({1.0, 2.0, 4.0, 8.0}, 0.75), 4.0);
}

}  // namespace
}  // namespace palpate::percentiles_test
