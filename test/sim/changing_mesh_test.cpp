// SPDX-License-Identifier: GPL-3.0-or-later
// A model that owns two organs, and whose meshes change in every cycle, behind the simulator.
#include <gtest/gtest.h>

#include <filesystem>

#include "palpate/advice/scene_verdict.h"
#include "palpate/sim/lockstep.h"
#include "slab_scene.h"
#include "support/splitting_model.h"

namespace palpate::sim {
namespace {

class ChangingMesh : public ::testing::Test {
 protected:
  test::SlabScene slab;
  Simulator simulator{scene::readScene(slab.file("", test::kSplittingOrgans))};
  const std::vector<LinkPoses> poses = {simulator.linkPoses(0, Eigen::VectorXd::Zero(6))};
};

TEST_F(ChangingMesh, ShowsItsNewShapeAfterEveryCycle) {
  ASSERT_EQ(simulator.numOrgans(), 2);
  EXPECT_EQ(simulator.positions(0).cols(), 7 * 7 * 4 - 5 * 5 * 2);  // none of those inside
  Lockstep lockstep(&simulator);
  Eigen::Index points = simulator.positions(0).cols();
  Eigen::Index triangles = simulator.surfaceState(0).triangles.cols();
  std::uint64_t revision = simulator.surfaceState(0).revision;
  for (int k = 0; k < 5; ++k) {
    const StepReport& report = lockstep.advance(0.01 * k, poses).report;
    EXPECT_EQ(report.mesh_changes, 2);
    EXPECT_EQ(report.nodes, simulator.positions(0).cols() + simulator.positions(1).cols());
    for (int organ = 0; organ < 2; ++organ) {
      const tissue::SurfaceState shape = simulator.surfaceState(organ);
      EXPECT_EQ(shape.positions.cols(), points + k + 1);
      EXPECT_EQ(shape.velocities.cols(), points + k + 1);
      EXPECT_EQ(shape.triangles.cols(), triangles + 2 * (k + 1));
      EXPECT_LT(shape.triangles.maxCoeff(), shape.positions.cols());
      EXPECT_EQ(shape.revision, revision + static_cast<std::uint64_t>(k) + 1);
    }
  }
  simulator.reset();
  EXPECT_EQ(simulator.surfaceState(0).triangles.cols(), triangles);
  EXPECT_GT(simulator.surfaceState(0).revision, revision + 5);
}

TEST_F(ChangingMesh, TellsWhichOrganTouched) {
  const StepResult& result = simulator.step(poses, 0.01);
  ASSERT_EQ(result.contacts.size(), 2U);
  for (int organ = 0; organ < 2; ++organ) {
    EXPECT_EQ(result.contacts[organ].organ, organ);
    EXPECT_EQ(result.contacts[organ].force_W.z(), organ + 1.0);
    EXPECT_EQ(result.contacts[organ].p_W, simulator.positions(organ).col(0));
  }
  EXPECT_EQ(result.instruments[0].spatial.force.z(), 3.0);
  EXPECT_EQ(result.report.imbalance, 0.0);
}

// Pictures of a model without cells are its surface, of as many points as it has by then.
TEST_F(ChangingMesh, IsWrittenAsTheSurfaceThatItHasThen) {
  for (int k = 0; k < 3; ++k) {
    simulator.step(poses, 0.01);
    const mesh::CellMesh cells = simulator.cells(1);
    EXPECT_EQ(cells.cells, simulator.surfaceState(1).triangles);
    const Points displacement = simulator.positions(1) - cells.points;
    const std::string file = slab.folder().path("other.vtu");
    formats::writeVtu(file, cells, {{"displacement", displacement}}, {});
    EXPECT_TRUE(std::filesystem::exists(file));
  }
}

// The mesh comes back with the state, and says that it is another one.
TEST_F(ChangingMesh, ComesBackWithTheState) {
  simulator.step(poses, 0.01);
  const SimulatorState state = simulator.state();
  const Points x = simulator.positions(0);
  const Eigen::Matrix3Xi triangles = simulator.surfaceState(0).triangles;
  simulator.step(poses, 0.01);
  const std::uint64_t revision = simulator.surfaceState(0).revision;
  simulator.restore(state);
  EXPECT_EQ(simulator.positions(0), x);
  EXPECT_EQ(simulator.surfaceState(0).triangles, triangles);
  EXPECT_GT(simulator.surfaceState(0).revision, revision);
  EXPECT_TRUE(simulator.state() == state);
}

TEST_F(ChangingMesh, HasALoadThatCanBeJudged) {
  const advice::SceneFacts facts = advice::sceneFacts(simulator, 2);
  EXPECT_EQ(facts.nodes, simulator.positions(0).cols() + simulator.positions(1).cols());
  EXPECT_GT(facts.edge_length, 0.005);
  EXPECT_LT(facts.edge_length, 0.05);
}

TEST_F(ChangingMesh, CannotBePlacedWhereItHasOtherPoints) {
  const Points before = simulator.positions(1);
  simulator.step(poses, 0.01);
  EXPECT_THROW(simulator.setPositions(1, before, before), std::invalid_argument);
  const Points now = simulator.positions(1);
  simulator.setPositions(1, 1.01 * now, 0.0 * now);
  EXPECT_EQ(simulator.positions(1), 1.01 * now);
}

}  // namespace
}  // namespace palpate::sim
