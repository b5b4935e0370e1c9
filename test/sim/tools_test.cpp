// SPDX-License-Identifier: GPL-3.0-or-later
// Tools that come, go, wait and leap.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "slab_scene.h"

namespace palpate::sim::tools_test {
namespace {

using test::SlabScene;

constexpr double kStep = 0.01;
// Heights of the joint z over the slab, whose top the ball touches at -0.056, a millimetre sagged.
constexpr double kAbove = -0.03, kPressed = -0.063, kInside = -0.08;

Eigen::VectorXd at(double z, double x = 0.0) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  q[0] = x;
  q[2] = z;
  return q;
}

class Tools : public ::testing::Test {
 protected:
  explicit Tools(bool proxy = false) {
    scene = slab.scene();
    scene.instruments[0].proxy.active = proxy;
    simulator = std::make_unique<Simulator>(scene);
  }
  const StepResult& step(const Eigen::VectorXd& q) {
    return simulator->step({simulator->linkPoses(0, q)}, kStep);
  }
  const StepResult& stepWithout() { return simulator->step({LinkPoses()}, kStep); }
  /// Slowly from above; the force there.
  double press() {
    double force = 0.0;
    for (int k = 0; k <= 100; ++k) {
      const StepResult& result = step(at(std::max(kPressed, kAbove - 5e-4 * k)));
      EXPECT_TRUE(result.report.ok()) << k;
      force = result.instruments[0].spatial.force.z();
    }
    return force;
  }

  SlabScene slab;
  scene::Scene scene;
  std::unique_ptr<Simulator> simulator;
};

class ProxiedTools : public Tools {
 protected:
  ProxiedTools() : Tools(true) {}
};

TEST_F(Tools, KnowsWhereAToolIsFree) {
  const auto free = [&](double z, double x = 0.0) {
    return simulator->isFree(0, simulator->linkPoses(0, at(z, x)));
  };
  EXPECT_TRUE(free(kAbove));
  EXPECT_TRUE(free(-0.0545));
  EXPECT_FALSE(free(-0.058));
  EXPECT_FALSE(free(kPressed));
  EXPECT_FALSE(free(kInside));
  EXPECT_TRUE(free(kInside, 0.06));  // next to the slab
}

TEST_F(Tools, OneThatIsNotThereFeelsNothingAndOneThatLeavesFades) {
  const Points at_rest = simulator->positions(0);
  EXPECT_FALSE(stepWithout().instruments[0].there);
  const double force = press();
  EXPECT_GT(force, 0.1);
  double last = force;
  for (int k = 1; k <= 30; ++k) {
    const StepResult& result = stepWithout();
    EXPECT_TRUE(result.report.ok());
    const InstrumentResult& tool = result.instruments[0];
    EXPECT_FALSE(tool.there);
    EXPECT_EQ(result.report.contacts, 0);
    EXPECT_LE(tool.spatial.force.z(), last);
    // Gone in rates.ramp, a tenth of a second, ten cycles.
    EXPECT_NEAR(tool.spatial.force.z(), force * std::max(0.0, 1.0 - 0.1 * k), 1e-9 * force);
    last = tool.spatial.force.z();
  }
  EXPECT_LT((simulator->positions(0) - at_rest).cwiseAbs().maxCoeff(), 3e-4);  // it goes back
}

TEST_F(ProxiedTools, GiveTheSameBitsAsOthersWhileAHandMovesThem) {
  Simulator plain(slab.scene());
  for (const Eigen::VectorXd& q : SlabScene::press()) {
    const Vec3 force = step(q).instruments[0].spatial.force;
    ASSERT_EQ(plain.step({plain.linkPoses(0, q)}, kStep).instruments[0].spatial.force, force);
  }
}

TEST_F(ProxiedTools, WaitOutsideWhereTheyBeginInside) {
  for (int k = 0; k < 20; ++k) {
    const StepResult& result = step(at(kInside));
    EXPECT_FALSE(result.instruments[0].there);
    EXPECT_TRUE(result.instruments[0].waiting);
    EXPECT_EQ(result.instruments[0].spatial.force, Vec3::Zero());
  }
  // Lifted out it is there, and feels the first press.
  EXPECT_TRUE(step(at(kAbove)).instruments[0].there);
  const double force = press();
  simulator->reset();
  EXPECT_NEAR(press(), force, 1e-3 * force);
  EXPECT_GT(force, 0.1);
}

TEST_F(ProxiedTools, WaitAfterAResetInContact) {
  const double first = press();
  simulator->reset();
  for (int k = 0; k < 20; ++k) {
    const StepResult& result = step(at(kPressed));
    EXPECT_TRUE(result.instruments[0].waiting);
    EXPECT_EQ(result.instruments[0].spatial.force, Vec3::Zero());
  }
  EXPECT_NEAR(press(), first, 1e-3 * first);
}

TEST_F(ProxiedTools, LeapsBecomeMotionsAndPressAsSlowOnesDo) {
  const double slow = press();
  for (const double leap : {0.05, 0.1, 0.5}) {
    simulator->reset();
    step(at(kPressed + leap));
    double force = 0.0;
    for (int k = 0; k < 100; ++k) {
      const StepResult& result = step(at(kPressed));
      ASSERT_TRUE(result.report.ok()) << leap << " cycle " << k;
      ASSERT_GT(result.report.min_jacobian, 0.1) << leap << " cycle " << k;
      force = result.instruments[0].spatial.force.z();
      if (k * kStep > leap + 0.02) {
        // Where it was commanded, exactly.
        EXPECT_EQ(result.instruments[0].X_WC.translation().z(),
                  simulator->linkPoses(0, at(kPressed)).back().translation().z());
      }
    }
    EXPECT_NEAR(force, slow, 0.02 * slow) << leap;
  }
}

TEST_F(ProxiedTools, GoOnFromAStateOnTheirWay) {
  step(at(kAbove));
  for (int k = 0; k < 2; ++k) step(at(kPressed + 0.01));
  const SimulatorState state = simulator->state();
  std::vector<Vec3> forces;
  for (int k = 0; k < 20; ++k) forces.push_back(step(at(kPressed)).instruments[0].spatial.force);
  EXPECT_GT(forces.back().z(), 0.1);
  Simulator other(scene);
  other.restore(state);
  for (int k = 0; k < 20; ++k) {
    const StepResult& result = other.step({other.linkPoses(0, at(kPressed))}, kStep);
    EXPECT_EQ(result.instruments[0].spatial.force, forces[static_cast<std::size_t>(k)]) << k;
  }
}

TEST_F(ProxiedTools, TakeOverTheStateOfOnesWithoutAProxy) {
  Simulator plain(slab.scene());
  for (int k = 0; k <= 70; ++k) {
    plain.step({plain.linkPoses(0, at(std::max(kPressed, kAbove - 5e-4 * k)))}, kStep);
  }
  const double force =
      plain.step({plain.linkPoses(0, at(kPressed))}, kStep).instruments[0].spatial.force.z();
  simulator->restore(plain.state());
  const InstrumentResult& tool = step(at(kPressed)).instruments[0];
  EXPECT_TRUE(tool.there);
  EXPECT_NEAR(tool.spatial.force.z(), force, 1e-3 * force);
}

}  // namespace
}  // namespace palpate::sim::tools_test
