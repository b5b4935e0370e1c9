// SPDX-License-Identifier: GPL-3.0-or-later
// The model of docs/adding_a_model.md, listed as that page says, in a scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpate/sim/simulator.h"
#include "palpate/tissue/model_list.h"
#include "sim/slab_scene.h"
#include "support/input_error.h"

namespace palpate {
namespace {

constexpr double kStep = 0.01;

class AddedModel : public ::testing::Test {
 protected:
  scene::Scene scene() const {
    return scene::readScene(slab.file("", "    model: lattice\n    damping: {mass: 20}\n"));
  }
  static sim::StepResult step(sim::Simulator* simulator, const Eigen::VectorXd& q) {
    return simulator->step({simulator->linkPoses(0, q)}, kStep);
  }

  test::SlabScene slab;
  const std::vector<Eigen::VectorXd> press = test::SlabScene::press();
};

TEST_F(AddedModel, IsKnownByItsName) {
  const std::vector<std::string> names = tissue::modelNames();
  EXPECT_EQ(std::count(names.begin(), names.end(), "lattice"), 1);
  EXPECT_EQ(names.front(), "fem");
  EXPECT_FALSE(tissue::ownsAllOrgans("lattice"));
  EXPECT_TRUE(test::hasProblem(
      test::problemsOf([&] { scene::readScene(slab.file("", "    model: latice\n")); }),
      "organs[0].model", "lattice"));
}

TEST_F(AddedModel, IsPressedAndLetGo) {
  sim::Simulator simulator(scene());
  ASSERT_EQ(simulator.warnings().size(), 1U);
  double peak = 0.0, deepest = 0.0;
  for (const Eigen::VectorXd& q : press) {
    const sim::StepResult result = step(&simulator, q);
    ASSERT_TRUE(result.report.ok());
    // Asleep, forces within the tolerance are let be.
    const bool asleep = result.report.skipped.sleeping_organs > 0;
    const double nodes = static_cast<double>(simulator.positions(0).cols());
    EXPECT_LT(result.report.imbalance, asleep ? std::sqrt(nodes) * result.report.tolerance : 1e-9);
    peak = std::max(peak, result.instruments[0].spatial.force.z());
    deepest = std::max(deepest, result.report.max_penetration);
  }
  EXPECT_GT(peak, 0.2);
  EXPECT_LT(deepest, 1e-3);
}

// It sags under gravity as finite elements of the same Young's modulus and Poisson's ratio do, but
// for the few directions that its springs have.
TEST_F(AddedModel, IsAsStiffAsTheMaterialSays) {
  scene::Scene elements = scene();
  elements.organs[0].model = "fem";
  elements.organs[0].material.constants["poisson_ratio"] = {0.25};
  const sim::Simulator fem(elements), lattice(scene());
  const auto sag = [](const sim::Simulator& simulator) {
    return (simulator.cells(0).points - simulator.positions(0)).row(2).mean();
  };
  EXPECT_GT(sag(fem), 1e-5);
  EXPECT_NEAR(sag(lattice), sag(fem), 0.25 * sag(fem));
}

TEST_F(AddedModel, SleepsUntilItIsTouched) {
  sim::Simulator simulator(scene());
  const Points begin = simulator.positions(0);
  int slept = 0;
  for (int k = 0; k < 10; ++k) {
    slept += static_cast<int>(step(&simulator, press[0]).report.skipped.sleeping_organs);
  }
  EXPECT_GE(slept, 8);
  // Of the two cycles before it sleeps, each moves less than a millionth of the organ's size.
  const double size = (begin.rowwise().maxCoeff() - begin.rowwise().minCoeff()).norm();
  EXPECT_LT((simulator.positions(0) - begin).cwiseAbs().maxCoeff(), 2e-6 * size);
  bool touched = false;
  for (int k = 0; k < 60; ++k) {
    const sim::StepReport report = step(&simulator, press[static_cast<std::size_t>(k)]).report;
    touched |= report.contacts > 0;
    EXPECT_FALSE(report.contacts > 0 && report.skipped.sleeping_organs > 0);
  }
  EXPECT_TRUE(touched);
}

TEST_F(AddedModel, GoesOnFromAStateWithTheSameBits) {
  sim::Simulator whole(scene()), other(scene());
  for (std::size_t saved : {4, 60}) {  // asleep, and touched
    whole.reset();
    for (std::size_t k = 0; k < saved; ++k) step(&whole, press[k]);
    other.restore(whole.state());
    for (std::size_t k = saved; k < saved + 30; ++k) {
      ASSERT_EQ(step(&whole, press[k]).instruments[0].spatial.force,
                step(&other, press[k]).instruments[0].spatial.force);
      ASSERT_TRUE(whole.state() == other.state()) << k;
    }
  }
  scene::Scene elements = scene();
  elements.organs[0].model = "fem";
  sim::Simulator fem(elements);
  EXPECT_THROW(fem.restore(whole.state()), std::invalid_argument);
}

TEST_F(AddedModel, RefusesWhatGravityWouldDragAway) {
  scene::Scene loose = scene();
  loose.organs[0].supports.clear();
  EXPECT_TRUE(test::hasProblem(test::problemsOf([&] { sim::Simulator simulator(loose); }),
                               "organs[0]", "translation along z"));
}

}  // namespace
}  // namespace palpate
