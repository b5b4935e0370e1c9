// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/simulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "palpate/tissue/fem/fem_tissue.h"
#include "slab_scene.h"
#include "support/input_error.h"

namespace palpate::sim::simulator_test {
namespace {

using test::SlabScene;

constexpr double kStep = 0.01;

class SimulatorOnSlab : public ::testing::Test {
 protected:
  StepResult step(const Eigen::VectorXd& q) {
    return simulator.step({simulator.linkPoses(0, q)}, kStep);
  }

  SlabScene slab;
  Simulator simulator{slab.scene()};
  const std::vector<Eigen::VectorXd> press = SlabScene::press();
};

TEST_F(SimulatorOnSlab, GivesTheWrenchOnTheToolInBothFrames) {
  double peak = 0.0;
  for (Eigen::VectorXd q : press) {
    q[5] = 0.5;  // yaw: body and world differ
    const StepResult result = step(q);
    const InstrumentResult& tool = result.instruments[0];
    EXPECT_TRUE(result.report.ok());
    Wrench sum;
    for (const ContactPoint& c : result.contacts) {
      sum += Wrench{c.force_W, (c.p_W - tool.X_WC.translation()).cross(c.force_W)};
    }
    EXPECT_LT((tool.spatial.force - sum.force).norm(), 1e-12);
    EXPECT_LT((tool.spatial.torque - sum.torque).norm(), 1e-12);
    EXPECT_LT((tool.X_WC.linear() * tool.body().force - tool.spatial.force).norm(), 1e-12);
    EXPECT_LT((tool.X_WC.linear() * tool.body().torque - tool.spatial.torque).norm(), 1e-12);
    EXPECT_EQ(result.report.contacts, static_cast<int>(result.contacts.size()));
    peak = std::max(peak, tool.spatial.force.z());
  }
  EXPECT_GT(peak, 0.2);
}

TEST_F(SimulatorOnSlab, BalancesForcesInEveryCycle) {
  const double nodes = static_cast<double>(simulator.positions(0).cols());
  for (const Eigen::VectorXd& q : press) {
    const StepReport report = step(q).report;
    EXPECT_LE(report.imbalance, std::sqrt(nodes) * report.tolerance + 1e-9);
    EXPECT_LE(report.residual, report.tolerance);
  }
}

TEST_F(SimulatorOnSlab, ResetAndRestoreRepeatEveryBit) {
  std::vector<Vec3> forces;
  for (const Eigen::VectorXd& q : press) forces.push_back(step(q).instruments[0].spatial.force);
  simulator.reset();
  for (std::size_t k = 0; k < press.size(); ++k) {
    ASSERT_EQ(step(press[k]).instruments[0].spatial.force, forces[k]) << "cycle " << k;
  }
  const SimulatorState state = simulator.state();
  const Points positions = simulator.positions(0);
  EXPECT_NEAR(state.time, 1.51, 1e-9);
  simulator.reset();
  EXPECT_NE(simulator.positions(0), positions);
  EXPECT_NE(simulator.state(), state);
  simulator.restore(state);
  EXPECT_EQ(simulator.positions(0), positions);
  EXPECT_EQ(simulator.state(), state);
}

TEST_F(SimulatorOnSlab, BadInputIsAStatusAndChangesNothing) {
  for (int k = 0; k < 60; ++k) step(press[k]);
  const Points before = simulator.positions(0);
  const Vec3 force = step(press[60]).instruments[0].spatial.force;
  const Points after = simulator.positions(0);
  EXPECT_NE(before, after);
  LinkPoses bad = simulator.linkPoses(0, press[61]);
  bad[2].translation().x() = std::numeric_limits<double>::quiet_NaN();
  LinkPoses far = simulator.linkPoses(0, press[61]), farther = far, farthest = far;
  far[2].translation().x() = 2.0 * kReach;
  farther[2].translation().z() = -1.0e200;  // finite, but not its square
  farthest.back().translation() = Vec3(-1.0e308, 1.0e308, 0.0);
  for (const StepResult& result :
       {simulator.step({bad}, kStep), simulator.step({}, kStep), simulator.step({far}, kStep),
        simulator.step({farther}, kStep), simulator.step({farthest}, kStep),
        simulator.step({simulator.linkPoses(0, press[61])}, 0.0),
        simulator.step({simulator.linkPoses(0, press[61])}, std::nan(""))}) {
    EXPECT_FALSE(result.report.ok());
    EXPECT_EQ(result.instruments[0].solved.force, force);
  }
  EXPECT_EQ(simulator.positions(0), after);
  EXPECT_TRUE(step(press[61]).report.ok());
}

TEST_F(SimulatorOnSlab, PlacesPointsWithoutAPast) {
  const Points x = simulator.positions(0);
  const Points v = Points::Constant(3, x.cols(), 0.01);
  EXPECT_THROW(simulator.setPositions(0, x.leftCols(5), v), std::invalid_argument);
  EXPECT_THROW(simulator.setPositions(0, x, std::nan("") * v), std::invalid_argument);
  simulator.setPositions(0, x, v);
  EXPECT_EQ(simulator.surfaceState(0).velocities, v);
}

TEST_F(SimulatorOnSlab, SaysWhereTheTimeWent) {
  PhaseTimes pressing;
  for (const Eigen::VectorXd& q : press) {
    const double begin = steadySeconds();
    const PhaseTimes phases = step(q).report.phases;
    EXPECT_LE(phases.cycle(), steadySeconds() - begin);
    EXPECT_GE(phases[Phase::kOther], 0.0);
    pressing += phases;
  }
  for (std::size_t k = 0; k < kNumCyclePhases; ++k) {
    const Phase phase = static_cast<Phase>(k);
    EXPECT_GT(pressing[phase], 0.0) << toString(phase);
  }
  // Little is left that no phase accounts for.
  EXPECT_LT(pressing[Phase::kOther], 0.3 * pressing.cycle());
  EXPECT_EQ(pressing[Phase::kHaptics], 0.0);

  simulator.reset();
  for (int k = 0; k < 20; ++k) step(Eigen::VectorXd::Zero(6));
  const StepReport asleep = step(Eigen::VectorXd::Zero(6)).report;
  EXPECT_EQ(asleep.skipped.sleeping_organs, 1);
  EXPECT_EQ(asleep.phases[Phase::kAssembly], 0.0);
  EXPECT_EQ(asleep.phases[Phase::kForces], 0.0);
}

// In half of the cycles most of the time has a phase; a cycle may be interrupted anywhere.
TEST(SimulatorOnSlabBy, EveryMethodSaysWhereItsTimeGoes) {
  const SlabScene slab;
  const std::vector<Eigen::VectorXd> press = SlabScene::press();
  for (const std::string& method : tissue::methodNames()) {
    Simulator simulator(
        scene::readScene(slab.file("solver: {method: " + method + "}", "    element: tet4\n")));
    std::vector<double> others;
    PhaseTimes sum;
    for (int k = 0; k < 80; ++k) {
      const PhaseTimes phases =
          simulator.step({simulator.linkPoses(0, press[k])}, kStep).report.phases;
      if (k >= 40) others.push_back(phases[Phase::kOther] / phases.cycle());
      sum += phases;
    }
    std::nth_element(others.begin(), others.begin() + 20, others.end());
    EXPECT_LT(others[20], 0.5) << method;
    EXPECT_GT(sum[Phase::kContact], 0.0) << method;
    EXPECT_GT(sum[Phase::kForces], 0.0) << method;
  }
}

TEST_F(SimulatorOnSlab, SkipsWhatIsNotNeeded) {
  int far = 0, slept = 0;
  for (int k = 0; k < 20; ++k) {
    const tissue::SkipCounters skipped = step(Eigen::VectorXd::Zero(6)).report.skipped;
    far += skipped.far_bodies;
    slept += skipped.sleeping_organs;
  }
  EXPECT_GT(far + slept, 20);
  EXPECT_GT(slept, 15);
}

// Files that a scene names, and what is wrong with them.
TEST(SimulatorLoading, SaysWhichKeyOfTheSceneIsWrong) {
  const SlabScene slab;
  const auto load = [](const scene::Scene& scene) {
    return [scene] { Simulator simulator(scene); };
  };
  scene::Scene scene = slab.scene();
  scene.organs[0].supports[0].select = mesh::PlaneRegion{2, 5.0, -1.0};
  EXPECT_TRUE(test::hasProblem(test::problemsOf(load(scene)), "organs[0].supports[0].select",
                               "must select at least one node"));
  scene = slab.scene();
  scene.organs[0].supports.clear();
  EXPECT_TRUE(test::hasProblem(test::problemsOf(load(scene)), "organs[0]", "translation along z"));
  scene = slab.scene();
  scene.organs[0].scale = 1000.0;
  EXPECT_TRUE(test::hasProblem(test::problemsOf(load(scene)), "organ slab.scale", "0.001"));
  scene = slab.scene();
  scene.instruments[0].control_frame = "tipp";
  EXPECT_TRUE(test::hasProblem(test::problemsOf(load(scene)), "instruments[0].control_frame",
                               "did you mean tip?"));
  scene = slab.scene();
  scene.instruments[0].urdf = "nowhere.urdf";
  EXPECT_THROW(Simulator simulator(scene), InputError);
  scene = slab.scene();
  scene.organs[0].tetrahedra = "nowhere.vtu";
  EXPECT_THROW(Simulator simulator(scene), InputError);
}

}  // namespace
}  // namespace palpate::sim::simulator_test
