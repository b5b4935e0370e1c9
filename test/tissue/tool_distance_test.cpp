// SPDX-License-Identifier: GPL-3.0-or-later
#include "tissue/adaptation/tool_distance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palpate::tissue::tool_distance_test {
namespace {

const instrument::Geometry kBall = instrument::Sphere{0.01};
const instrument::Geometry kRod = instrument::Capsule{0.002, 0.05};

Pose at(double x, double angle = 0.0) {
  Pose X = Pose::Identity();
  X.translation() = Vec3(x, 0.0, 0.0);
  X.linear() = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
  return X;
}

const Points kTissue = Points::Zero(3, 1);

TEST(ToolDistance, IsFromWhereToolsGoOnTo) {
  ToolDistance tools(0.003, 0.02);
  ASSERT_TRUE(tools.look({{&kBall, 0, at(0.0), at(0.001)}}, 4.0, kTissue, 0.0));
  EXPECT_NEAR(tools.distance(Vec3(0.005, 0.0, 0.0)), -0.01, 1e-15);
  EXPECT_NEAR(tools.distance(Vec3(0.025, 0.0, 0.0)), 0.01, 1e-15);
  // Not farther than it is taken to, and not at all where it rests.
  tools.look({{&kBall, 0, at(0.0), at(0.01)}}, 4.0, kTissue, 0.0);
  EXPECT_NEAR(tools.distance(Vec3(0.03, 0.0, 0.0)), -0.01, 1e-15);
  tools.look({{&kBall, 0, at(0.01), at(0.01)}}, 4.0, kTissue, 0.0);
  EXPECT_NEAR(tools.distance(Vec3(0.01, 0.0, 0.0)), -0.01, 1e-15);
}

// A rod along z that turns about y by 0.1 a cycle.
TEST(ToolDistance, TurnsOnAsToolsTurn) {
  ToolDistance tools(0.003, 1.0);
  tools.look({{&kRod, 0, at(0.0), at(0.0, 0.1)}}, 3.0, kTissue, 0.0);
  const Vec3 end = 0.05 * Vec3(std::sin(0.4), 0.0, std::cos(0.4));
  EXPECT_NEAR(tools.distance(end), -0.002, 1e-12);
}

// What was right for where a tool is now is right as long as it goes there.
TEST(ToolDistance, LooksAgainOnceAToolGoesElsewhere) {
  ToolDistance tools(0.003, 0.02);
  const auto look = [&](double from, double to) {
    return tools.look({{&kBall, 0, at(from), at(to)}}, 4.0, kTissue, 0.0);
  };
  EXPECT_TRUE(look(0.0, 0.001));  // goes to 0.005
  tools.suited();
  EXPECT_FALSE(look(0.001, 0.002));   // to 0.006
  EXPECT_TRUE(look(0.002, 0.0035));   // to 0.0095
  EXPECT_TRUE(look(0.0035, 0.0015));  // back
  // Where it comes to rest it has to be righter.
  EXPECT_FALSE(look(0.0051, 0.0051));
  EXPECT_TRUE(look(0.006, 0.006));
  EXPECT_FALSE(look(0.0057, 0.006));  // goes to 0.0072
  tools.forget();
  EXPECT_TRUE(look(0.005, 0.005));
}

TEST(ToolDistance, OnlyOfToolsThatComeNear) {
  ToolDistance tools(0.003, 0.02);
  EXPECT_FALSE(tools.look({{&kBall, 0, at(0.2), at(0.2)}}, 4.0, kTissue, 0.1));
  EXPECT_TRUE(tools.look({{&kBall, 0, at(0.13), at(0.125)}}, 4.0, kTissue, 0.1));
}

}  // namespace
}  // namespace palpate::tissue::tool_distance_test
