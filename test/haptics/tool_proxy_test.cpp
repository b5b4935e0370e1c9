// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/tool_proxy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace palpate::haptics::tool_proxy_test {
namespace {

using LinkPoses = ToolProxy::LinkPoses;

constexpr double kStep = 0.01;

const ToolProxy::Free kFree = [](const LinkPoses&) { return true; };
const ToolProxy::Free kInside = [](const LinkPoses&) { return false; };

// A shaft, which is the control frame, and a jaw 10 mm in front of it, opened by `jaw` [rad].
LinkPoses tool(const Vec3& at, double yaw = 0.0, double jaw = 0.0) {
  Pose shaft = poseFromXyzRpy(at, Vec3(0.0, 0.0, yaw));
  return {shaft, shaft * poseFromXyzRpy(Vec3(0.01, 0.0, 0.0), Vec3(0.0, jaw, 0.0))};
}

ToolProxy proxy(const ProxySettings& settings = {}) { return {settings, 0, {0, 1}}; }

double angle(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(Mat3(a.linear().transpose() * b.linear())).angle();
}
bool same(const LinkPoses& a, const LinkPoses& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Pose& x, const Pose& y) { return x.matrix() == y.matrix(); });
}

TEST(ToolProxy, IsWhereItIsCommandedWhileAHandMovesIt) {
  ToolProxy p = proxy();
  for (int k = 0; k < 500; ++k) {
    const double t = kStep * k;  // a fast hand: 0.6 m/s, 7 m/s^2, jaws and wrist at once
    const LinkPoses at =
        tool(Vec3(0.05 * std::sin(12.0 * t), 0.0, 0.0), std::sin(9.0 * t), std::sin(8.0 * t));
    ASSERT_TRUE(p.follow(at, kStep, kFree));
    ASSERT_TRUE(same(p.poses(), at)) << "cycle " << k;
  }
}

TEST(ToolProxy, GoesToAFarCommandAsFastAsItMayAndStaysThere) {
  const ProxySettings limits;
  for (const double dt : {0.01, 0.002, 0.001}) {
    ToolProxy p = proxy();
    LinkPoses last = tool(Vec3::Zero());
    p.follow(last, dt, kFree);
    const LinkPoses goal = tool(Vec3(0.3, -0.4, 0.0), 2.0, 0.5);
    Vec3 velocity = Vec3::Zero();
    int cycles = 0;
    for (; cycles < 10000 && !same(p.poses(), goal); ++cycles) {
      p.follow(goal, dt, kFree);
      const Vec3 v = (p.poses()[0].translation() - last[0].translation()) / dt;
      ASSERT_LE(v.norm(), limits.max_speed * (1.0 + 1e-9));
      ASSERT_LE(angle(p.poses()[0], last[0]), limits.max_angular_speed * dt * (1.0 + 1e-9));
      if (!same(p.poses(), goal)) {
        ASSERT_LE((v - velocity).norm(), limits.max_acceleration * dt * (1.0 + 1e-9));
      }
      // Straight there, and not beyond.
      ASSERT_LT(p.poses()[0].translation().cross(goal[0].translation()).norm(), 1e-12);
      ASSERT_LE(p.poses()[0].translation().norm(), 0.5 + 1e-9);
      velocity = v;
      last = p.poses();
    }
    EXPECT_NEAR(cycles * dt, 0.5 / limits.max_speed, 0.03) << dt;
    p.follow(goal, dt, kFree);
    EXPECT_TRUE(same(p.poses(), goal));
  }
}

TEST(ToolProxy, JawsKeepTheirLimitWhileTheToolIsStill) {
  const ProxySettings limits;
  ToolProxy p = proxy();
  LinkPoses last = tool(Vec3::Zero());
  p.follow(last, kStep, kFree);
  const LinkPoses goal = tool(Vec3::Zero(), 0.0, 1.2);
  for (int k = 0; k < 20 && !same(p.poses(), goal); ++k) {
    p.follow(goal, kStep, kFree);
    EXPECT_LE(angle(p.poses()[1], last[1]), limits.max_angular_speed * kStep * (1.0 + 1e-9));
    EXPECT_EQ(p.poses()[0].matrix(), goal[0].matrix());
    last = p.poses();
  }
  EXPECT_TRUE(same(p.poses(), goal));
}

TEST(ToolProxy, ComesOnlyWhereItIsFree) {
  ToolProxy p = proxy();
  EXPECT_FALSE(p.there());
  EXPECT_FALSE(p.waiting());
  EXPECT_FALSE(p.follow(tool(Vec3::Zero()), kStep, kInside));
  EXPECT_TRUE(p.waiting());
  EXPECT_TRUE(p.poses().empty());
  const LinkPoses outside = tool(Vec3(0.0, 0.0, 0.3));
  EXPECT_TRUE(p.follow(outside, kStep, kFree));
  EXPECT_FALSE(p.waiting());
  EXPECT_TRUE(same(p.poses(), outside));
  // Once there, it may go in.
  const LinkPoses in = tool(Vec3(0.0, 0.0, 0.295));
  EXPECT_TRUE(p.follow(in, kStep, kInside));
  EXPECT_TRUE(same(p.poses(), in));
}

TEST(ToolProxy, LeavesAndComesBackAnywhereElse) {
  ToolProxy p = proxy();
  p.follow(tool(Vec3::Zero()), kStep, kFree);
  p.leave();
  EXPECT_FALSE(p.there());
  const LinkPoses far = tool(Vec3(0.5, 0.0, 0.0));
  EXPECT_TRUE(p.follow(far, kStep, kFree));
  EXPECT_TRUE(same(p.poses(), far));
}

TEST(ToolProxy, GoesOnFromItsState) {
  ToolProxy p = proxy();
  p.follow(tool(Vec3::Zero()), kStep, kFree);
  const LinkPoses goal = tool(Vec3(0.1, 0.0, 0.0), 1.0);
  for (int k = 0; k < 3; ++k) p.follow(goal, kStep, kFree);
  StateWriter state;
  p.save(&state);
  ToolProxy other = proxy();
  StateReader reader(state.bytes());
  other.restore(&reader);
  reader.finish();
  for (int k = 0; k < 20; ++k) {
    p.follow(goal, kStep, kFree);
    other.follow(goal, kStep, kFree);
    EXPECT_TRUE(same(p.poses(), other.poses()));
  }
}

TEST(ToolProxy, RefusesLimitsThatAreNone) {
  for (double ProxySettings::*limit :
       {&ProxySettings::max_speed, &ProxySettings::max_acceleration,
        &ProxySettings::max_angular_speed, &ProxySettings::max_angular_acceleration}) {
    for (const double value : {0.0, -1.0, std::nan("")}) {
      ProxySettings settings;
      settings.*limit = value;
      EXPECT_THROW(ToolProxy(settings, 0, {0}), std::invalid_argument);
    }
  }
}

}  // namespace
}  // namespace palpate::haptics::tool_proxy_test
