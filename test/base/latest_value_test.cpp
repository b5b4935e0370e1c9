// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/latest_value.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

namespace palpate::latest_value_test {
namespace {

TEST(LatestValue, StartsWithTheInitialValue) {
  LatestValue<int> value(7);
  EXPECT_FALSE(value.hasNew());
  EXPECT_EQ(value.read(), 7);
}

TEST(LatestValue, ReadsTheNewestAndDropsTheRest) {
  LatestValue<int> value(0);
  for (int i = 1; i <= 5; ++i) value.write(i);
  EXPECT_TRUE(value.hasNew());
  EXPECT_EQ(value.read(), 5);
  EXPECT_FALSE(value.hasNew());
  EXPECT_EQ(value.read(), 5);
}

// A torn value would mix two writes; a stale one would run backwards.
TEST(LatestValue, IsNeverTornNorOldBetweenTwoThreads) {
  using Wide = std::array<int, 64>;
  constexpr int kWrites = 200000;
  LatestValue<Wide> value{Wide{}};
  std::thread writer([&] {
    Wide wide;
    for (int i = 1; i <= kWrites; ++i) {
      wide.fill(i);
      value.write(wide);
    }
  });
  int last = 0;
  while (last < kWrites) {
    const Wide& wide = value.read();
    for (int entry : wide) ASSERT_EQ(entry, wide[0]);
    ASSERT_GE(wide[0], last);
    last = wide[0];
  }
  writer.join();
}

}  // namespace
}  // namespace palpate::latest_value_test
