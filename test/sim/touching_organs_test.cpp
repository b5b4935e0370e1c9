// SPDX-License-Identifier: GPL-3.0-or-later
// A scene of two organs that act on each other, behind the simulator.
#include <gtest/gtest.h>

#include "palpate/sim/simulator.h"
#include "slab_scene.h"
#include "support/repulsion.h"

// The table of interactions of this program, in place of the library's.
namespace palpate::tissue {

const std::vector<InteractionEntry>& interactions() {
  static const std::vector<InteractionEntry> kInteractions = {test::repulsion<0>()};
  return kInteractions;
}

}  // namespace palpate::tissue

namespace palpate::sim {
namespace {

// Beside the slab, 5 mm apart.
constexpr char kOther[] = R"(
  - name: other
    tetrahedra: slab.vtu
    pose: {position: [0.055, -0.05, 0]}
    material: {law: stable_neo_hookean, young_modulus: 6.0e3, poisson_ratio: 0.45, density: 1060}
    supports: [{select: {plane: {axis: z, at: 0}}}]
)";

class TouchingOrgans : public ::testing::Test {
 protected:
  scene::Scene scene(const std::string& extra = "") const {
    return scene::readScene(slab.file(extra, kOther));
  }
  test::SlabScene slab;
};

TEST_F(TouchingOrgans, BalanceInEveryCycle) {
  Simulator simulator(scene());
  double most = 0.0;
  for (const Eigen::VectorXd& q : test::SlabScene::press()) {
    const StepResult& result = simulator.step({simulator.linkPoses(0, q)}, 0.01);
    ASSERT_TRUE(result.report.ok());
    const double nodes = std::sqrt(simulator.positions(0).cols());
    EXPECT_LE(result.report.imbalance, 2.0 * nodes * result.report.tolerance + 1e-9);
    EXPECT_EQ(result.report.skipped.apart_organs, 0);
    for (const ContactPoint& contact : result.contacts) EXPECT_EQ(contact.organ, 0);
    most = std::max(most, result.instruments[0].spatial.force.norm());
  }
  EXPECT_GT(most, 0.2);
}

TEST_F(TouchingOrgans, GoOnFromAStateOfTheScene) {
  Simulator simulator(scene()), again(scene());
  const std::vector<Eigen::VectorXd> press = test::SlabScene::press();
  for (int k = 0; k < 60; ++k) simulator.step({simulator.linkPoses(0, press[k])}, 0.01);
  again.restore(SimulatorState::fromBytes(simulator.state().bytes()));
  for (int k = 60; k < 100; ++k) {
    simulator.step({simulator.linkPoses(0, press[k])}, 0.01);
    again.step({again.linkPoses(0, press[k])}, 0.01);
    ASSERT_EQ(simulator.positions(0), again.positions(0));
    ASSERT_EQ(simulator.positions(1), again.positions(1));
  }
  EXPECT_EQ(simulator.state().bytes(), again.state().bytes());
}

// The keys reach the tissue.
TEST_F(TouchingOrgans, AreLeftApartWhereTheSceneSaysSo) {
  Simulator touching(scene()), apart(scene("contact: {apart: [{organ: other, other: slab}]}")),
      off(scene("contact: {organs: false}"));
  for (const Eigen::VectorXd& q : test::SlabScene::press()) {
    for (Simulator* simulator : {&touching, &apart, &off}) {
      simulator->step({simulator->linkPoses(0, q)}, 0.01);
    }
    ASSERT_EQ(apart.positions(0), off.positions(0));
    ASSERT_EQ(apart.positions(1), off.positions(1));
  }
  EXPECT_GT((touching.positions(1) - apart.positions(1)).cwiseAbs().maxCoeff(), 1e-5);
}

}  // namespace
}  // namespace palpate::sim
