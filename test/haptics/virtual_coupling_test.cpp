// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/virtual_coupling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "palpate/haptics/local_model.h"
#include "palpate/haptics/tool_renderer.h"

namespace palpate::haptics::virtual_coupling_test {
namespace {

constexpr double kCycle = 0.01;

// A surface at z = 0 that pushes up by K per depth, from a tenth of a millimetre on in full.
Wrench surface(double K, const Vec3& p) {
  Wrench wrench;
  const double depth = std::max(0.0, -p.z()), blend = 1e-4;
  wrench.force.z() = depth < blend ? 0.5 * K * depth * depth / blend : K * (depth - 0.5 * blend);
  return wrench;
}

DeviceSettings late() {
  DeviceSettings device;
  device.delay = 0.006;
  return device;
}

struct Followed {
  Vec3 tool, force;
  double worst = 0.0;  // of the solves' forces [N]
};
// The tool of a hand that goes down to `depth` at 50 mm/s and stays.
Followed press(ToolRenderer* renderer, double K, double depth, double seconds) {
  Followed f;
  RenderTarget target;
  for (double t = 0.0; t < seconds; t += kCycle) {
    const Vec3 hand(0, 0, std::max(0.003 - 0.05 * t, -depth));
    const Vec3 to = renderer->target(hand);
    const Wrench wrench = surface(K, to);
    target = renderer->observe(to, to, wrench, kCycle);
    f.tool = to;
    f.force = target.contact.at(hand, Vec3::Zero()).force;
    f.worst = std::max(f.worst, wrench.force.norm());
  }
  return f;
}

TEST(VirtualCoupling, IsNotThereWhereTheTissueIsSoft) {
  ToolRenderer renderer({}, late(), 1e-3);
  const double K = 0.9 * DeviceLimits(late(), 1e-3).maxStiffness();
  const Followed f = press(&renderer, K, 0.008, 1.0);
  EXPECT_EQ(f.tool, Vec3(0, 0, -0.008));
  EXPECT_DOUBLE_EQ(f.force.z(), surface(K, f.tool).force.z());
}

// From ten times too stiff to bone: in series with the spring as stiff as the device can render,
// the force that of the tissue at the tool.
TEST(VirtualCoupling, MakesAnyTissueAsStiffAsTheDeviceCanRender) {
  const double limit = DeviceLimits(late(), 1e-3).maxStiffness();
  for (const double K : {2.0 * limit, 10.0 * limit, 1e4, 1e5}) {
    ToolRenderer renderer({}, late(), 1e-3);
    const Followed f = press(&renderer, K, 0.008, 3.0);
    const double felt = f.force.z() / 0.008;
    EXPECT_GT(felt, 0.55 * limit) << K;
    EXPECT_LT(felt, 1.3 * limit) << K;
    EXPECT_NEAR(f.force.z(), surface(K, f.tool).force.z(), 0.05 * f.force.z()) << K;
    EXPECT_LT(f.worst, std::max(2.0, 1.1 * K * 0.05 * kCycle)) << K;  // one cycle's way
  }
}

// Lifting off and coming back in another place gives the same force again.
TEST(VirtualCoupling, PressingAgainGivesTheFirstPress) {
  ToolRenderer renderer({}, late(), 1e-3);
  const Followed first = press(&renderer, 1e5, 0.008, 3.0);
  for (int k = 0; k < 100; ++k) {
    const Vec3 to = renderer.target(Vec3(0, 0, 0.02));
    renderer.observe(to, to, surface(1e5, to), kCycle);
  }
  EXPECT_EQ(renderer.target(Vec3(0, 0, 0.02)), Vec3(0, 0, 0.02));
  const Followed again = press(&renderer, 1e5, 0.008, 3.0);
  EXPECT_NEAR(again.force.z(), first.force.z(), 0.02 * first.force.z());
}

// A wall whose normal trembles, as facets make it: no force aside that it has not.
TEST(VirtualCoupling, FeelsAWallAlongItsNormalAlone) {
  VirtualCoupling coupling(late(), 1e-3);
  LocalModel local;
  std::mt19937 random(2);
  std::normal_distribution<double> tilt(0.0, 0.1);
  for (int k = -20; k < 300; ++k) {
    const Vec3 hand(0, 0, k < 0 ? -5e-4 * (20 + k) + 2e-3 : -0.008);
    const Vec3 to = coupling.target(hand);
    Wrench wrench = surface(1e5, to);
    wrench.force += wrench.force.z() * Vec3(tilt(random), tilt(random), 0.0);
    coupling.observe(local.observe(to, wrench), false, Vec3::Zero(), kCycle);
    if (k < 20) continue;
    EXPECT_LT((coupling.target(hand) - hand).head<2>().norm(), 3e-3) << k;
    EXPECT_LT(coupling.rendered().at(hand, Vec3::Zero()).force.norm(), 1.5) << k;
  }
}

// From bone onto soft tissue, while the tool was still on its way back to the hand: it arrives, and
// the hand feels the tissue where the tool is.
TEST(VirtualCoupling, ComesBackToTheHandOnSoftTissueToo) {
  ToolRenderer renderer({}, late(), 1e-3);
  press(&renderer, 1e5, 0.008, 1.0);
  const Vec3 hand(0.02, 0, -0.008);
  RenderTarget target;
  for (int k = 0; k < 200; ++k) {
    const Vec3 to = renderer.target(hand);
    // At 20 mm aside there is nothing for two cycles, and then 30 N/m.
    target = renderer.observe(to, to, k < 2 ? Wrench() : surface(30.0, to), kCycle);
    EXPECT_NEAR(target.contact.at(hand, Vec3::Zero()).force.z(),
                k < 2 ? 0.0 : surface(30.0, to).force.z(), 1e-2)
        << k;
  }
  EXPECT_LT((renderer.target(hand) - hand).norm(), 1e-4);
}

// One solve of a tool that is there says nothing: the next goes on from where it was.
TEST(VirtualCoupling, GoesOnAfterASolveThatSaysNothing) {
  ToolRenderer renderer({}, late(), 1e-3);
  press(&renderer, 1e5, 0.008, 2.0);
  const Vec3 hand(0, 0, -0.008), before = renderer.target(hand);
  EXPECT_FALSE(renderer.fade().live);
  EXPECT_EQ(renderer.target(hand), before);
}

TEST(VirtualCoupling, ForgetsAToolThatIsLost) {
  ToolRenderer renderer({}, late(), 1e-3);
  press(&renderer, 1e5, 0.008, 1.0);
  EXPECT_NE(renderer.target(Vec3(0, 0, -0.008)), Vec3(0, 0, -0.008));
  EXPECT_FALSE(renderer.lose().live);
  EXPECT_EQ(renderer.target(Vec3(0, 0, -0.008)), Vec3(0, 0, -0.008));
}

}  // namespace
}  // namespace palpate::haptics::virtual_coupling_test
