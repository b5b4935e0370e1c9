// SPDX-License-Identifier: GPL-3.0-or-later
// A liver that nobody here made: meshed, loaded and palpated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "palpate/scene/organ_assembly.h"
#include "palpate/sim/simulator.h"
#include "support/source_folder.h"

namespace palpate::sim::extra_liver_test {
namespace {

TEST(ExtraLiver, IsMeshedLoadedAndPalpated) {
  const char* folder = std::getenv("PALPATE_EXTRA_DATA");
  if (!folder || !*folder)
    GTEST_SKIP() << "needs meshes that are not shipped: a folder in PALPATE_EXTRA_DATA";
  scene::Scene scene;
  scene.file = (std::filesystem::path(folder) / "scene.yaml").string();  // not there; for paths
  scene.gravity.setZero();
  scene.organs.resize(1);
  scene::OrganConfig& organ = scene.organs[0];
  organ.name = "liver";
  organ.surface = "organs/liver-smooth.obj";
  organ.scale = 0.04;
  organ.edge_length.coarsest = 0.02;
  organ.material.constants = {{"young_modulus", {6.0e3}}, {"poisson_ratio", {0.45}}};
  std::vector<std::string> warnings;
  const Points X = scene::readOrganMesh(scene, organ, {}, &warnings).points;
  const Vec3 low = X.rowwise().minCoeff(), high = X.rowwise().maxCoeff();
  organ.supports.resize(1);
  organ.supports[0].select = mesh::BoxRegion{low, Vec3(high.x(), high.y(), low.z() + 0.03)};

  Eigen::Index top;
  X.row(2).maxCoeff(&top);
  scene.instruments.resize(1);
  scene::InstrumentConfig& probe = scene.instruments[0];
  probe.name = "probe";
  probe.urdf = test::sourceFolder() + "/config/instruments/probe.urdf";
  probe.control_frame = "tip";
  probe.base.position = Vec3(X.col(top)) + Vec3(0.0, 0.0, 0.015);  // the ball 10 mm above the top

  Simulator simulator(scene);
  EXPECT_GT(simulator.positions(0).cols(), 500);
  double peak = 0.0;
  for (int k = 0; k <= 60; ++k) {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
    q[2] = -0.025 * std::min(k / 50.0, 1.0);  // 15 mm into the liver
    const StepResult& result = simulator.step({simulator.linkPoses(0, q)}, 0.01);
    ASSERT_TRUE(result.report.ok()) << "cycle " << k;
    EXPECT_LE(result.report.imbalance, 40.0 * result.report.tolerance + 1e-9);
    EXPECT_GT(result.report.min_jacobian, 0.0);
    peak = std::max(peak, result.instruments[0].spatial.force.z());
  }
  EXPECT_GT(peak, 0.2);
  EXPECT_LT(peak, 20.0);
}

}  // namespace
}  // namespace palpate::sim::extra_liver_test
