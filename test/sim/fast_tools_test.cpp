// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "palpate/sim/simulator.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::sim::fast_tools_test {
namespace {

constexpr double kStep = 0.01, kDeep = 0.014;

// The shipped slab with edges of 2 mm under the probe's ball of 5 mm, at whose joint z of 0 it
// touches: a cycle at 1 m/s goes over five of them.
class FastTools : public ::testing::Test {
 protected:
  FastTools() {
    const std::string config = test::sourceFolder() + "/config/";
    scene = scene::readScene(folder.write("slab.yaml", R"(
gravity: [0, 0, 0]
organs:
  - name: slab
    surface: )" + config + R"(organs/slab.obj
    edge_length: {coarsest: 0.015, near: [{finest: 0.002, point: [0, 0, 0.03], radius: 0.006, growth: 0.4}]}
    material: {law: neo_hookean, young_modulus: 6.0e3, poisson_ratio: 0.45, density: 1000}
    damping: {mass: 5.0}
    supports: [{select: {plane: {axis: z, at: 0, tolerance: 1.0e-4}}}]
instruments:
  - name: probe
    urdf: )" + config + R"(instruments/probe.urdf
    base: {position: [0, 0, 0.035]}
    control_frame: tip
contact: {stiffness: 3.0e8}
)"));
  }

  test::TempFolder folder;
  scene::Scene scene;
};

// Where the way was cut by the tool's size alone, elements in front of it folded at 0.3 and 1 m/s,
// and cycles did not converge.
TEST_F(FastTools, AStabEndsWhereASlowPressDoes) {
  Simulator simulator(scene);
  double slow = 0.0;
  for (const double speed : {0.1, 0.3, 1.0}) {
    simulator.reset();
    double force = 0.0, largest = 0.0;
    for (int k = 0; k < 80; ++k) {
      const double t = kStep * k;
      Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
      q[2] = -std::min(kDeep, 0.02 * std::min(t, 0.15) + speed * std::max(t - 0.15, 0.0));
      const StepResult& result = simulator.step({simulator.linkPoses(0, q)}, kStep);
      ASSERT_TRUE(result.report.ok())
          << speed << " m/s, cycle " << k << " " << solver::toString(result.report.status);
      ASSERT_GT(result.report.min_jacobian, 0.1) << speed << " m/s, cycle " << k;
      force = result.instruments[0].spatial.force.z();
      largest = std::max(largest, force);
    }
    if (speed == 0.1) slow = force;
    EXPECT_NEAR(force, slow, 0.002 * slow) << speed;
    EXPECT_LT(largest, 1.05 * slow) << speed;  // the slab is too light to add much
  }
  EXPECT_GT(slow, 0.5);
}

// With too few iterations a cycle may end far from a balance: its force is none to be felt.
TEST_F(FastTools, WhatIsFarFromABalanceIsNotFelt) {
  scene.solver.max_newton_iterations = 2;
  scene.contact.model = "penalty";
  Simulator simulator(scene);
  int told = 0, held_back = 0;
  double felt = 0.0;
  for (int k = 0; k < 60; ++k) {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
    q[2] = 0.002 - (k < 30 ? 0.004 * std::min(k % 6, 4) : 0.0002 * (k - 30));
    const StepResult& result = simulator.step({simulator.linkPoses(0, q)}, kStep);
    Vec3 force = Vec3::Zero();
    for (const ContactPoint& c : result.contacts) force += c.force_W;
    const InstrumentResult& tool = result.instruments[0];
    const bool near = result.report.ok() || result.report.residual <= 0.5 * force.norm();
    EXPECT_EQ(tool.live, near) << k;
    if (near) {
      EXPECT_NEAR((tool.solved.force - force).norm(), 0.0, 1e-12) << k;
      ++told;
    } else {
      EXPECT_LE(tool.spatial.force.norm(), felt) << k;
      ++held_back;
    }
    felt = tool.spatial.force.norm();
  }
  EXPECT_GT(told, 20);
  EXPECT_GE(held_back, 3);
}

}  // namespace
}  // namespace palpate::sim::fast_tools_test
