// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/needle_channel.h"
#include "slab.h"
#include "support/random.h"

namespace palpate::tissue::needle_test {
namespace {

using test::onTool;
using test::Slab;

constexpr double kTop = 0.04, kHalf = 0.05, kRadius = 5e-4;  // [m]
constexpr double kSpeed = 0.02, kCycle = 0.01;               // [m/s], [s]
const contact::NeedleSettings kNeedle{0.25, 0.1, 6.0};
const instrument::Geometry kShape = instrument::Capsule{kRadius, kHalf - kRadius};

// Its tip at a depth under the surface at rest, straight down.
Pose at(double depth) {
  return poseFromXyzRpy(Vec3(0.052, 0.047, kTop - depth + kHalf), Vec3::Zero());
}

struct Insertion {
  Insertion() {
    slab.settings.gravity.setZero();
    slab.settings.needles = true;
    slab.settings.sample_spacing = 5e-4;
    tissue = slab.make();
  }
  const TissueStep& go(double depth) {
    contact::Obstacle needle{&kShape, 0, at(last), at(depth)};
    needle.needle = &kNeedle;
    last = depth;
    const TissueStep& out = tissue->step({needle}, kCycle);
    push = onTool(out).z();
    entry = -1.0;
    for (const TissueContact& c : out.contacts) entry = std::max(entry, c.p_W.z());
    imbalance = (onTool(out) - out.support_force - out.inertia_force).norm();
    return out;
  }
  double inserted() const { return entry - (kTop - last); }

  Slab slab{Eigen::Vector3i(10, 10, 4)};
  std::unique_ptr<TissueModel> tissue;
  double last = -0.002, push = 0.0, entry = 0.0, imbalance = 0.0;
};

// A state that was made to harm: of a body of five points no place may name another one.
TEST(NeedleChannel, RestoresNoPlaceBeyondItsBody) {
  contact::NeedleChannel channel(kNeedle, kHalf, 1e3, 1e-3);
  for (const int node : {4, 5, -1}) {
    contact::NeedleChannel saved(kNeedle, kHalf, 1e3, 1e-3);
    saved.addTip({{0, 1, 2, node}, Eigen::Vector4d::Constant(0.25)}, Vec3::Zero(), 0.1);
    StateWriter out;
    saved.save(&out);
    StateReader in(out.bytes());
    if (node == 4) {
      channel.restore(&in, 5);
      EXPECT_FALSE(channel.empty());
    } else {
      EXPECT_THROW(channel.restore(&in, 5), std::invalid_argument) << node;
    }
  }
}

// Indentation up to the puncture, cutting and friction that grows with the depth, friction alone on
// the way out [Okamura, Simone, O'Leary 2004, fig. 1].
TEST(Needle, ShowsTheThreePhases) {
  Insertion in;
  double before = 0.0, highest = 0.0;
  bool punctured = false;
  for (double depth = -0.002; depth < 0.03; depth += kSpeed * kCycle) {
    const TissueStep& out = in.go(depth);
    ASSERT_TRUE(out.ok()) << depth;
    EXPECT_LT(in.imbalance, 1e-3) << depth;
    if (!punctured) {
      highest = std::max(highest, in.push);
      if (highest >= kNeedle.puncture_force) {
        punctured = true;
        EXPECT_LT(before, kNeedle.puncture_force);
      } else {
        EXPECT_GE(in.push, before - 1e-3) << depth;
      }
      before = in.push;
    } else if (depth > 0.02) {
      const double law = kNeedle.cutting_force + kNeedle.shaft_friction * in.inserted();
      EXPECT_NEAR(in.push, law, 0.05 * law) << "at " << depth;
    }
  }
  ASSERT_TRUE(punctured);
  const double deepest = in.inserted();
  EXPECT_GT(deepest, 0.01);
  for (double depth = 0.03; depth > -0.004; depth -= kSpeed * kCycle) {
    ASSERT_TRUE(in.go(depth).ok());
    if (depth > 0.01 && depth < 0.018) {
      EXPECT_NEAR(in.push, -kNeedle.shaft_friction * in.inserted(),
                  0.05 * kNeedle.shaft_friction * in.inserted())
          << "at " << depth;
    }
  }
  for (int k = 0; k < 300; ++k) in.go(-0.004);
  EXPECT_EQ(in.push, 0.0);
  EXPECT_LT((in.tissue->positions() - in.slab.mesh.points).cwiseAbs().maxCoeff(), 1e-4);
}

// The tissue goes where the needle in it goes sideways.
TEST(Needle, CarriesTheTissueSideways) {
  Insertion in;
  for (double depth = -0.002; depth < 0.03; depth += kSpeed * kCycle) in.go(depth);
  double side = 0.0;
  const Pose from = at(in.last);
  for (int k = 1; k <= 20; ++k) {
    Pose begin = from, end = from;
    begin.translation().x() += 2e-4 * (k - 1);
    end.translation().x() += 2e-4 * k;
    contact::Obstacle needle{&kShape, 0, begin, end};
    needle.needle = &kNeedle;
    const TissueStep& out = in.tissue->step({needle}, kCycle);
    ASSERT_TRUE(out.ok());
    side = onTool(out).x();
    for (const TissueContact& c : out.contacts) {
      EXPECT_LT(std::abs(c.p_W.x() - end.translation().x()), 2e-3);
    }
  }
  EXPECT_LT(side, -0.02);
}

TEST(Needle, GoesOnFromAStateToTheBit) {
  Insertion one, two;
  for (double depth = -0.002; depth < 0.02; depth += kSpeed * kCycle) one.go(depth);
  two.tissue->restore(one.tissue->state());
  two.last = one.last;
  for (int k = 0; k < 20; ++k) {
    one.go(0.02 - 5e-4 * k);
    two.go(0.02 - 5e-4 * k);
    ASSERT_EQ(one.push, two.push);
    ASSERT_EQ(one.tissue->positions(), two.tissue->positions());
  }
}

// One that is taken away leaves nothing behind.
TEST(Needle, ThatIsGoneLetsGo) {
  Insertion in;
  for (double depth = -0.002; depth < 0.02; depth += kSpeed * kCycle) in.go(depth);
  for (int k = 0; k < 300; ++k) in.tissue->step({}, kCycle);
  EXPECT_LT((in.tissue->positions() - in.slab.mesh.points).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(NeedleChannel, GradientAndHessianAreThoseOfTheValue) {
  test::Random random;
  contact::NeedleChannel channel({0.1, 0.05, 3.0}, 0.02, 200.0, 1e-3);
  channel.setPose(Vec3(0.0, 0.0, 0.02), -Vec3::UnitZ());
  Points x = random.points(12, 2e-3);
  for (int k = 0; k < 3; ++k) {
    contact::NeedleChannel::MaterialPoint place{{4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3},
                                                {0.1, 0.2, 0.3, 0.4}};
    channel.addTip(place, Vec3::Zero(), 0.02);
    channel.endStep(x);
    x.row(2).array() += 1e-3;
  }
  int slipping = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Points at = x + random.points(12, 4e-4), d = random.points(12, 1.0);
    Points g = Points::Zero(3, 12), plus = g, minus = g;
    EXPECT_DOUBLE_EQ(channel.addGradient(at, &g), channel.value(at));
    constexpr double h = 1e-8;
    EXPECT_NEAR(g.cwiseProduct(d).sum(),
                (channel.value(at + h * d) - channel.value(at - h * d)) / (2.0 * h),
                1e-6 * g.norm() * d.norm() + 1e-9);
    std::vector<std::pair<int, int>> pairs;
    for (int a = 0; a < 12; ++a) {
      for (int b = 0; b < a; ++b) pairs.emplace_back(a, b);
    }
    fem::Stiffness K(fem::BlockMatrix(12, pairs));
    channel.addHessian(at, fem::Tangent::kExact, &K);
    Points Kd;
    K.multiply(d, &Kd);
    channel.addGradient(at + h * d, &plus);
    channel.addGradient(at - h * d, &minus);
    EXPECT_LT((Kd - (plus - minus) / (2.0 * h)).norm(), 1e-5 * Kd.norm());
    slipping += channel.tipForce(at) >= 0.05;
  }
  EXPECT_GT(slipping, 0);
}

}  // namespace
}  // namespace palpate::tissue::needle_test
