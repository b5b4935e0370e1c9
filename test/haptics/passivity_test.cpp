// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/haptics/passivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>
#include <stdexcept>

#include "palpate/haptics/velocity_estimate.h"

namespace palpate::haptics::passivity_test {
namespace {

constexpr double kTick = 1e-3;
constexpr double kStiffness = 500.0;

Vec3 spring(const Vec3& p) { return Vec3(0, 0, kStiffness * std::max(0.0, -p.z())); }

// In and out of a spring that answers `late` ticks late: energy that comes out of the port.
struct Energies {
  double true_out, watched_out, dissipated;
};
Energies pressTwice(int late, double max_damping, int every = 1) {
  VelocityEstimate velocity;
  PassivitySettings settings;
  settings.max_damping = max_damping;
  PassivityController controller(settings);
  std::deque<Vec3> forces(static_cast<std::size_t>(late), Vec3::Zero());
  Vec3 sent = Vec3::Zero(), p = Vec3(0, 0, 0.002), reported = p;
  double out = 0.0, largest = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 next(0.0, 0.0, 0.002 - 0.007 * (1.0 - std::cos(2.0 * M_PI * 2.0 * kTick * k)));
    out += sent.dot(next - p);
    if (next.z() > 0.0 && sent == Vec3::Zero()) out = 0.0;
    largest = std::max(largest, out);
    p = next;
    if (k % every == 0) reported = p;
    forces.push_back(spring(p));
    const Vec3 force = forces.front();
    forces.pop_front();
    velocity.update(reported, kTick);
    sent = force + controller.update(reported, velocity.velocity(), sent, force, kTick);
  }
  return {largest, controller.largestOut(), controller.dissipated()};
}

TEST(Passivity, LeavesAPassiveSpringAlone) {
  // One that is held for a tick T gives K T int v^2 dt, here 0.7 mJ a press, at most.
  const Energies run = pressTwice(0, 5.0);
  EXPECT_LT(run.watched_out, 7e-4);
  EXPECT_LT(run.dissipated, 1.4e-3);
}

TEST(Passivity, TakesBackWhatALateSpringGives) {
  const Energies without = pressTwice(15, 0.0), with = pressTwice(15, 20.0);
  EXPECT_GT(without.true_out, 5e-3);
  EXPECT_NEAR(without.watched_out, without.true_out, 0.02 * without.true_out);
  EXPECT_EQ(without.dissipated, 0.0);
  EXPECT_LT(with.true_out, 0.35 * without.true_out);
  EXPECT_GT(with.dissipated, 0.5 * without.true_out);
}

// What it hears has felt what was sent before: told so, it sees the energy at the device.
TEST(Passivity, PairsPosesWithTheForcesThatTheyHaveFelt) {
  constexpr int kLate = 10;
  PassivitySettings settings;
  settings.max_damping = 0.0;
  PassivityController told(settings, kLate * kTick), untold(settings);
  std::deque<Vec3> under_way(kLate, Vec3::Zero());
  Vec3 sent = Vec3::Zero(), p = Vec3::Zero();
  double out = 0.0, largest = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const double dt = k % 7 == 0 ? 1.1 * kTick : kTick;  // ticks are not all of one length
    const Vec3 next(0.0, 0.0, -0.004 - 0.003 * std::sin(2.0 * M_PI * 3.0 * kTick * k));
    out += under_way.front().dot(next - p);
    under_way.pop_front();
    largest = std::max(largest, out);
    p = next;
    told.update(p, Vec3::Zero(), sent, spring(p), dt);
    untold.update(p, Vec3::Zero(), sent, spring(p), dt);
    sent = spring(p);
    under_way.push_back(sent);
  }
  EXPECT_GT(largest, 1e-2);
  EXPECT_NEAR(told.largestOut(), largest, 0.15 * largest);
  EXPECT_LT(untold.largestOut(), 0.5 * largest);
}

TEST(Passivity, CountsTheSameForADeviceThatReportsEachTenthTick) {
  const Energies fast = pressTwice(15, 0.0), slow = pressTwice(15, 0.0, 10);
  EXPECT_NEAR(slow.watched_out, fast.watched_out, 0.1 * fast.watched_out);
}

// A pose that leaps into the tissue, as that of another publisher may, is no credit; out of it no
// debt.
TEST(Passivity, CountsNoLeapAsWork) {
  const Vec3 force(0.0, 0.0, 2.0);
  for (const double leap : {-0.05, 0.05}) {
    PassivityController controller;
    const Vec3 v(0.0, 0.0, 0.1);
    Vec3 p = Vec3::Zero();
    controller.update(p, Vec3::Zero(), force, force, kTick);
    p.z() += leap;
    controller.update(p, Vec3::Zero(), force, force, kTick);
    EXPECT_EQ(controller.largestOut(), 0.0);
    for (int k = 0; k < 20; ++k) {
      p += kTick * v;  // along the force: energy comes out
      controller.update(p, v, force, force, kTick);
    }
    EXPECT_NEAR(controller.largestOut(), 20 * kTick * 0.1 * 2.0, 1e-9) << leap;
    EXPECT_GT(controller.damping(), 0.0);
  }
}

TEST(Passivity, KeepsToItsLimitAndDampsOnlyWhereSomethingTouches) {
  PassivitySettings settings;
  settings.max_damping = 1.5;
  PassivityController controller(settings);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  VelocityEstimate velocity;
  Vec3 p = Vec3::Zero(), sent = Vec3::Zero();
  for (int k = 0; k < 10000; ++k) {
    p += 1e-4 * Vec3(u(random), u(random), u(random));
    const Vec3 force = k % 100 < 50 ? Vec3(u(random), u(random), u(random)) : Vec3(Vec3::Zero());
    velocity.update(p, kTick);
    const Vec3 added = controller.update(p, velocity.velocity(), sent, force, kTick);
    EXPECT_LE(controller.damping(), 1.5);
    EXPECT_TRUE(added.allFinite());
    if (force == Vec3::Zero()) {
      EXPECT_EQ(added, Vec3::Zero());
    }
    sent = force + added;
  }
}

TEST(Passivity, RefusesSettingsThatAreNone) {
  PassivitySettings settings;
  settings.max_damping = -1.0;
  EXPECT_THROW(PassivityController{settings}, std::invalid_argument);
  settings = {};
  EXPECT_THROW(PassivityController(settings, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::haptics::passivity_test
