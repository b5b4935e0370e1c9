// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/messages/stamps.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace palpate::node::stamps_test {
namespace {

// As it is read from a message, which may have any numbers.
ros::Time stamp(std::uint32_t sec, std::uint32_t nsec) {
  ros::Time time;
  time.sec = sec;
  time.nsec = nsec;
  return time;
}

TEST(Stamps, AreApartWhateverStandsInThem) {
  const ros::Time first = stamp(0, 1), last = stamp(0xffffffff, 0xffffffff);
  EXPECT_NEAR(secondsBetween(first, last), 4294967299.3, 0.1);
  EXPECT_NEAR(secondsBetween(last, first), -4294967299.3, 0.1);
  EXPECT_DOUBLE_EQ(secondsBetween(ros::Time(5, 500000000), ros::Time(7, 0)), 1.5);
  EXPECT_EQ(secondsBetween(last, last), 0.0);
}

}  // namespace
}  // namespace palpate::node::stamps_test
