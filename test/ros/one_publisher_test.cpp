// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/input/one_publisher.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

namespace palpate::node::one_publisher_test {
namespace {

constexpr double kPatience = 0.2;

class OnePublisherTest : public ::testing::Test {
 protected:
  bool takes(const OnePublisher::Connection& connection, const std::string& name, double time) {
    return publisher_.takes(connection, name, start_ + seconds(time));
  }
  std::string conflict(double time) { return publisher_.conflict(start_ + seconds(time)); }

  const Steady::time_point start_ = Steady::now();
  OnePublisher publisher_{kPatience};
  OnePublisher::Connection arm_ = boost::make_shared<int>(1), other_ = boost::make_shared<int>(2);
};

TEST_F(OnePublisherTest, TheFirstCountsAndBothAreNamed) {
  EXPECT_TRUE(takes(arm_, "/arm", 0.0));
  EXPECT_EQ(conflict(0.0), "");
  EXPECT_FALSE(takes(other_, "/other", 0.01));
  EXPECT_TRUE(takes(arm_, "/arm", 0.02));
  EXPECT_NE(conflict(0.02).find("/arm and /other both publish it"), std::string::npos);
  EXPECT_EQ(conflict(0.5), "");
}

TEST_F(OnePublisherTest, ANameIsNoProof) {
  EXPECT_TRUE(takes(arm_, "/arm", 0.0));
  EXPECT_FALSE(takes(other_, "/arm", 0.01));
  EXPECT_NE(conflict(0.02).find("two call themselves /arm"), std::string::npos);
}

TEST_F(OnePublisherTest, SilenceEndsATurn) {
  takes(arm_, "/arm", 0.0);
  EXPECT_FALSE(takes(other_, "/other", 0.19));
  EXPECT_TRUE(takes(other_, "/other", 0.21));
  EXPECT_EQ(conflict(0.21), "");
  EXPECT_FALSE(takes(arm_, "/arm", 0.22));
}

TEST_F(OnePublisherTest, AConnectionThatIsGoneHasNoTurn) {
  takes(arm_, "/arm", 0.0);
  arm_ = boost::make_shared<int>(3);  // the same, who connected anew
  EXPECT_TRUE(takes(arm_, "/arm", 0.01));
  EXPECT_FALSE(takes(other_, "/arm", 0.02));
}

}  // namespace
}  // namespace palpate::node::one_publisher_test
