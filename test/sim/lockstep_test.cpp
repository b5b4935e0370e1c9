// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/sim/lockstep.h"

#include <gtest/gtest.h>

#include "slab_scene.h"

namespace palpate::sim::lockstep_test {
namespace {

class LockstepOnSlab : public ::testing::Test {
 protected:
  std::vector<LinkPoses> at(int k) const { return {simulator.linkPoses(0, press[k])}; }

  test::SlabScene slab;
  Simulator simulator{slab.scene()};
  Lockstep lockstep{&simulator};
  const std::vector<Eigen::VectorXd> press = test::SlabScene::press();
};

TEST_F(LockstepOnSlab, StepsToEachInputsTime) {
  EXPECT_DOUBLE_EQ(lockstep.advance(5.0, at(0)).report.step, 0.01);
  EXPECT_NEAR(lockstep.advance(5.004, at(1)).report.step, 0.004, 1e-12);
  EXPECT_NEAR(lockstep.advance(5.010, at(2)).report.step, 0.006, 1e-12);
}

TEST_F(LockstepOnSlab, CutsLongGapsIntoEqualParts) {
  lockstep.advance(0.0, at(0));
  const double begin = simulator.time();
  EXPECT_NEAR(lockstep.advance(0.035, at(60)).report.step, 0.035 / 4, 1e-12);
  EXPECT_EQ(lockstep.parts(), 4);
  EXPECT_NEAR(simulator.time() - begin, 0.035, 1e-12);
  EXPECT_NEAR(lockstep.result().instruments[0].X_WC.translation().z(), 0.1 + press[60][2], 1e-12);
}

TEST_F(LockstepOnSlab, TheSameTimeAgainDoesNothing) {
  lockstep.advance(0.0, at(0));
  const Vec3 place = lockstep.advance(0.01, at(40)).instruments[0].X_WC.translation();
  const double time = simulator.time();
  EXPECT_EQ(lockstep.advance(0.01, at(60)).instruments[0].X_WC.translation(), place);
  EXPECT_EQ(lockstep.parts(), 0);
  EXPECT_EQ(simulator.time(), time);
}

TEST_F(LockstepOnSlab, LiveCyclesAreOneStepEachWhateverTheTime) {
  Lockstep live(&simulator, Cycles::kLive);
  std::vector<std::uint64_t> hashes;
  for (int k = 0; k < 60; ++k) {
    const StepResult& result = live.advance(0.003 * k * k, at(k));
    EXPECT_EQ(result.report.step, simulator.scene().solver.step);
    EXPECT_EQ(live.parts(), 1);
    hashes.push_back(result.report.state_hash);
  }
  EXPECT_NEAR(simulator.time(), 0.6, 1e-9);
  live.advance(100.0, at(60));
  for (int k = 0; k < 60; ++k) {  // again from rest
    ASSERT_EQ(live.advance(5.0 + k, at(k)).report.state_hash, hashes[static_cast<std::size_t>(k)]);
  }
}

TEST_F(LockstepOnSlab, TimeThatGoesBackBeginsAnew) {
  std::vector<Vec3> forces;
  for (int k = 0; k < 60; ++k) {
    forces.push_back(lockstep.advance(0.01 * k, at(k)).instruments[0].spatial.force);
  }
  EXPECT_GT(forces.back().norm(), 0.0);
  for (int k = 0; k < 60; ++k) {
    ASSERT_EQ(lockstep.advance(0.01 * k, at(k)).instruments[0].spatial.force, forces[k]);
  }
}

}  // namespace
}  // namespace palpate::sim::lockstep_test
