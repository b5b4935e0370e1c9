// SPDX-License-Identifier: GPL-3.0-or-later
#include "haptics/limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace palpate::haptics::limits_test {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kHuge = std::numeric_limits<double>::max();

TEST(Limits, ShortenAnythingThatPointsSomewhere) {
  const Vec3 v(3.0, 0.0, -4.0);
  EXPECT_EQ(clamped(v, 5.0), v);
  EXPECT_TRUE(clamped(v, 1.0).isApprox(0.2 * v, 1e-15));
  EXPECT_TRUE(clamped(1.0e300 * v, 1.0).isApprox(0.2 * v, 1e-12));
  EXPECT_TRUE(
      clamped(Vec3::Constant(-kHuge), std::sqrt(3.0)).isApprox(Vec3::Constant(-1.0), 1e-12));
  EXPECT_EQ(clamped(Vec3(1.0, -kInf, 2.0), 0.5), Vec3(0.0, -0.5, 0.0));
  EXPECT_TRUE(
      clamped(Vec3(kInf, kHuge, -kInf), std::sqrt(2.0)).isApprox(Vec3(1.0, 0.0, -1.0), 1e-12));
}

TEST(Limits, RefuseWhatIsNoLimit) {
  for (const double value : {-1.0, kInf, std::nan("")}) {
    EXPECT_THROW(requirePositive("It", "length", value), std::invalid_argument);
    EXPECT_THROW(requireNotNegative("It", "length", value), std::invalid_argument);
  }
  EXPECT_THROW(requirePositive("It", "length", 0.0), std::invalid_argument);
  EXPECT_NO_THROW(requireNotNegative("It", "length", 0.0));
}

}  // namespace
}  // namespace palpate::haptics::limits_test
