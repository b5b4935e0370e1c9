// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/input/tf_frames.h"

#include <gtest/gtest.h>
#include <tf2/exceptions.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <limits>

namespace palpate::node::tf_frames_test {
namespace {

constexpr double kPatience = 0.2;
const ros::Time kNow(1700000000.0);

geometry_msgs::TransformStamped transform(const std::string& parent, const std::string& child,
                                          double z, const ros::Time& stamp = kNow) {
  geometry_msgs::TransformStamped t;
  t.header.stamp = stamp;
  t.header.frame_id = parent;
  t.child_frame_id = child;
  t.transform.translation.z = z;
  t.transform.rotation.w = 1.0;
  return t;
}

class TfFramesTest : public ::testing::Test {
 protected:
  std::string moving(const geometry_msgs::TransformStamped& t, double time = 0.0,
                     const OnePublisher::Connection& connection = arm(),
                     const std::string& name = "/arm") {
    return frames_.take(t, false, {connection, name, start_ + seconds(time)});
  }
  std::string fixed(const geometry_msgs::TransformStamped& t) {
    return frames_.take(t, true, {arm(), "/arm", start_});
  }
  double height() {
    return buffer_.lookupTransform("world", "tip", ros::Time()).transform.translation.z;
  }
  static OnePublisher::Connection arm() {
    static const OnePublisher::Connection one = boost::make_shared<int>(1);
    return one;
  }

  const OnePublisher::Connection other_ = boost::make_shared<int>(2);
  const Steady::time_point start_ = Steady::now();
  tf2::BufferCore buffer_;
  TfFrames frames_{{"tip"}, kPatience, &buffer_};
};

TEST_F(TfFramesTest, KeepsWhatLiesBetweenTheWorldAndTheLinks) {
  fixed(transform("/world", "base", 1.0));  // before anybody knows that it is wanted
  fixed(transform("world", "table", 3.0));
  for (int k = 0; k < 1000; ++k) moving(transform("world", "crowd" + std::to_string(k), 1.0));
  moving(transform("arm", "tip", 0.25));
  moving(transform("base", "arm", 0.5));
  EXPECT_EQ(height(), 1.75);
  EXPECT_FALSE(buffer_._frameExists("crowd7"));
  EXPECT_FALSE(buffer_._frameExists("table"));
}

TEST_F(TfFramesTest, FindsAWorldThatIsAChild) {
  fixed(transform("map", "world", 1.0));
  moving(transform("map", "tip", 3.0));
  EXPECT_EQ(height(), 2.0);
}

TEST_F(TfFramesTest, ALoopIsNoEnd) {
  fixed(transform("a", "b", 1.0));
  fixed(transform("b", "a", 1.0));
  moving(transform("b", "tip", 1.0));
  EXPECT_THROW(height(), tf2::TransformException);
}

TEST_F(TfFramesTest, IgnoresWhatABufferCannotTake) {
  moving(transform("world", "tip", 0.5));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ros::Time& stamp : {ros::Time(0xffffffff, 0), ros::Time(0x80000000, 0)}) {
    EXPECT_NE(moving(transform("world", "tip", 1.0, stamp), 0.01), "");
  }
  EXPECT_NE(moving(transform("world", "tip", nan, kNow + ros::Duration(1.0)), 0.02), "");
  geometry_msgs::TransformStamped turned =
      transform("world", "tip", 1.0, kNow + ros::Duration(1.0));
  turned.transform.rotation.w = 1.0e200;
  EXPECT_NE(moving(turned, 0.03), "");
  EXPECT_NE(fixed(transform("world", "tip", 1.0)), "");
  EXPECT_EQ(moving(transform("tip", "tip", 1.0), 0.04), "");
  EXPECT_EQ(moving(transform("", std::string(100000, 'n'), 1.0), 0.05), "");
  EXPECT_EQ(height(), 0.5);
}

TEST_F(TfFramesTest, OfTwoPublishersOfAFrameOneCounts) {
  moving(transform("world", "tip", 0.5));
  const ros::Time later = kNow + ros::Duration(1000.0);
  EXPECT_EQ(moving(transform("world", "tip", 9.0, later), 0.01, other_, "/other"), "");
  EXPECT_EQ(height(), 0.5);
  const std::string conflict = frames_.conflict(start_ + seconds(0.02));
  EXPECT_NE(conflict.find("frame tip: /arm and /other both publish it"), std::string::npos);
  // It falls silent: the other's turn, whose clock is another one, and then its own again.
  moving(transform("world", "tip", 9.0, later), 1.0, other_, "/other");
  EXPECT_EQ(height(), 9.0);
  moving(transform("world", "tip", 0.75, kNow + ros::Duration(2.0)), 2.0);
  EXPECT_EQ(height(), 0.75);
}

// A publisher of what is static is started again: it sends all once, and what is not wanted of what
// its first run sent is kept all the while.
TEST_F(TfFramesTest, APublisherOfStaticFramesMayStartAgain) {
  OnePublisher::Connection first = boost::make_shared<int>(3);
  const auto sends = [&](const OnePublisher::Connection& who, const std::string& frame, double z) {
    frames_.take(transform("world", frame, z), true, {who, "/state_publisher", start_});
  };
  moving(transform("base", "tip", 0.5));
  sends(first, "base", 1.0);
  sends(first, "camera", 1.0);
  first.reset();
  sends(other_, "base", 2.0);
  EXPECT_EQ(height(), 2.5);
  EXPECT_EQ(frames_.conflict(start_), "");
}

// A clock that is put back by less than what a buffer remembers.
TEST_F(TfFramesTest, GoesOnFromStampsThatWentBack) {
  moving(transform("world", "tip", 0.5));
  EXPECT_EQ(moving(transform("world", "tip", 0.5), 0.01), "");
  EXPECT_NE(moving(transform("world", "tip", 9.0, kNow - ros::Duration(0.1)), 0.02), "");
  EXPECT_EQ(height(), 0.5);
  EXPECT_EQ(moving(transform("world", "tip", 0.75, kNow - ros::Duration(3.0)), 0.03), "");
  EXPECT_EQ(height(), 0.75);
}

TEST_F(TfFramesTest, ForgetsWhatMovedWhenTimeGoesBack) {
  fixed(transform("world", "base", 1.0));
  moving(transform("base", "tip", 0.5));
  frames_.forget();
  EXPECT_THROW(height(), tf2::TransformException);
  moving(transform("base", "tip", 0.25, kNow - ros::Duration(5.0)), 0.01);
  EXPECT_EQ(height(), 1.25);
}

}  // namespace
}  // namespace palpate::node::tf_frames_test
