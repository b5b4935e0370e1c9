// SPDX-License-Identifier: GPL-3.0-or-later
// Each criterion is met by a cycle that went well, and by none in which what it looks for is wrong.
#include "palpate/torture/criteria.h"

#include <gtest/gtest.h>

#include <cmath>

#include <limits>
#include <map>
#include <string>

#include "palpate/sim/lockstep.h"
#include "palpate/torture/scene_files.h"
#include "support/temp_folder.h"
#include "torture/checks.h"
#include "torture/draw_body.h"
#include "torture/organ_cells.h"
#include "torture/recomputed_residual.h"

namespace palpate::torture::criteria_test {
namespace {

// A block of tet4 that a ball presses, leaves, and that comes to rest.
TortureScene pressedBlock() {
  TortureScene scene;
  scene.category = "press";
  TortureOrgan organ;
  organ.name = "organ";
  organ.shape = "block";
  organ.size = Vec3(0.04, 0.04, 0.02);
  organ.mesh = mesh::boxMesh(organ.size, Eigen::Vector3i(4, 4, 2));
  organ.law = "neo_hookean";
  organ.element = "tet4";
  organ.young = 1e4;
  organ.poisson = 0.3;
  organ.constants = constantsOf(organ.law, organ.young, organ.poisson);
  organ.mass_damping = 100.0;
  scene.organs.push_back(organ);
  TortureTool tool;
  tool.name = "tool";
  tool.shape = "ball";
  tool.size = Vec3(0.008, 0.0, 0.0);
  scene.tools.push_back(tool);
  constexpr int kDown = 12, kRows = 80;
  scene.trajectory.columns = {"x", "y", "z", "roll", "pitch", "yaw"};
  scene.trajectory.values = Eigen::MatrixXd::Zero(6, kRows);
  for (int row = 0; row < kRows; ++row) {
    scene.trajectory.t.push_back(0.01 * row);
    const double z = row < kDown ? 0.03 - 0.0005 * row : 1.0;
    scene.trajectory.values.col(row).head<3>() = Vec3(0.02, 0.02, z);
  }
  scene.leave = kDown;
  scene.rests = true;
  return scene;
}

class Criteria : public ::testing::Test {
 protected:
  Criteria() : scene(pressedBlock()) { begin(); }
  void begin() {
    files = writeScene(scene, folder.path(""));
    row = 0;
    lockstep.reset();
    simulator = std::make_unique<sim::Simulator>(scene::readScene(files.scene));
    lockstep = std::make_unique<sim::Lockstep>(simulator.get());
    all.clear();
    for (NamedCriterion& one : criteria(scene, *simulator))
      all[one.name] = std::move(one.criterion);
  }
  const sim::StepResult& play(std::size_t rows) {
    for (; row < rows; ++row) {
      const Eigen::VectorXd q = scene.trajectory.values.col(static_cast<Eigen::Index>(row));
      lockstep->advance(scene.trajectory.t[row], {simulator->linkPoses(0, q)});
      for (auto& [name, criterion] : all) {
        EXPECT_EQ(criterion->check(cycle(lockstep->result())), "") << name << " in row " << row;
      }
    }
    return lockstep->result();
  }
  Cycle cycle(const sim::StepResult& result) const { return {*simulator, result, row, 0.01, 1}; }
  std::string told(const std::string& name, const sim::StepResult& result) {
    return all.at(name)->check(cycle(result));
  }

  const test::TempFolder folder;
  TortureScene scene;
  SceneFiles files;
  std::unique_ptr<sim::Simulator> simulator;
  std::unique_ptr<sim::Lockstep> lockstep;
  std::map<std::string, std::unique_ptr<Criterion>> all;
  std::size_t row = 0;
};

TEST_F(Criteria, AreMetByASceneThatGoesWell) {
  EXPECT_GT(play(10).report.contacts, 0);
  play(scene.trajectory.t.size());
  for (auto& [name, criterion] : all) EXPECT_EQ(criterion->finish(), "") << name;
}

TEST_F(Criteria, SeeNumbersThatAreNotFinite) {
  sim::StepResult result = play(10);
  result.report.elastic_energy = std::numeric_limits<double>::infinity();
  EXPECT_EQ(told("finite", result), "elastic_energy");
  result = lockstep->result();
  result.instruments[0].solved.torque.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(told("finite", result), "wrench");
  result = lockstep->result();
  result.report.status = solver::SolveStatus::kNonFinite;
  EXPECT_EQ(told("finite", result), "status non_finite");
}

TEST_F(Criteria, SeeAShapeInsideOutThatIsToldToBeConverged) {
  sim::StepResult result = play(10);
  result.report.min_jacobian = -0.5;
  EXPECT_NE(told("inverted", result), "");
  result.report.status = solver::SolveStatus::kInverted;
  EXPECT_EQ(told("inverted", result), "");
  // What is told is fine, what is shown is not.
  Points x = simulator->positions(0);
  x.row(2) *= -1.0;
  simulator->setPositions(0, x, Points::Zero(3, x.cols()));
  EXPECT_NE(told("inverted", lockstep->result()), "");
}

TEST_F(Criteria, SeeAResidualThatIsNotThatOfTheForces) {
  sim::StepResult result = play(10);
  result.report.residual = 2.0 * result.report.tolerance;
  EXPECT_NE(told("truth", result), "");
  // A point that is moved by a micrometre is out of balance.
  play(11);
  Points x = simulator->positions(0);
  x(2, x.cols() - 1) += 1e-6;
  const sim::StepResult honest = lockstep->result();
  // The criterion must not know it: setPositions() is of the simulator alone.
  simulator->setPositions(0, x, Points::Zero(3, x.cols()));
  EXPECT_NE(told("truth", honest), "");
}

// Of every element, of two laws and of fibres, with inertia and without: cycles that went well are
// balanced as computed anew, and a point that is moved by a hair is not.
class Residuals : public Criteria, public ::testing::WithParamInterface<const char*> {};

TEST_P(Residuals, AreComputedAnewOfEachElement) {
  for (const char* law : {"neo_hookean", "holzapfel_ogden"}) {
    for (const char* integrator : {"backward_euler", "bdf2", "static"}) {
      TortureOrgan& organ = scene.organs.front();
      organ.element = GetParam();
      organ.law = law;
      organ.constants = constantsOf(organ.law, organ.young, organ.poisson);
      organ.contrast = 1e3;
      scene.integrator = integrator;
      begin();
      play(9);
      RecomputedResidual residual(scene, *simulator);
      play(10);
      residual.remember(*simulator);
      const sim::StepResult last = play(11);
      EXPECT_EQ(residual.check(cycle(last)), "") << law << " " << integrator;
      EXPECT_EQ(residual.numChecked(), 1) << law << " " << integrator;
      Points x = simulator->positions(0);
      x(2, x.cols() - 1) += 1e-5;
      simulator->setPositions(0, x, Points::Zero(3, x.cols()));
      EXPECT_NE(told("truth", last), "") << law << " " << integrator;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Residuals, ::testing::Values("tet4", "anp", "p1p1", "tet10", "tet10p"),
                         [](const auto& i) { return std::string(i.param); });

TEST_F(Criteria, SeeAWrenchThatIsNotTheSumOfItsContacts) {
  sim::StepResult result = play(10);
  ASSERT_GT(result.instruments[0].solved.force.norm(), 0.01);
  result.instruments[0].solved.force *= 1.0 + 1e-6;
  EXPECT_NE(told("truth", result), "");
  result = lockstep->result();
  result.instruments[0].contacts = 0;
  EXPECT_NE(told("wrench", result), "");
  // The same force far above the organ is carried along.
  result = lockstep->result();
  result.instruments[0].X_WC.translation().z() = 0.2;
  EXPECT_NE(told("wrench", result), "");
}

TEST_F(Criteria, SeeForcesThatDoNotCancel) {
  sim::StepResult result = play(10);
  result.report.imbalance = 1e-3;
  EXPECT_NE(told("truth", result), "");
  result.report.status = solver::SolveStatus::kIterationLimit;
  EXPECT_EQ(told("truth", result), "");
}

TEST_F(Criteria, SeeForcesAndPointsBeyondAllBounds) {
  sim::StepResult result = play(10);
  result.instruments[0].solved.force = Vec3(0.0, 0.0, 1e9);
  EXPECT_NE(told("bounded", result), "");
  result.report.status = solver::SolveStatus::kIterationLimit;  // which is told
  EXPECT_EQ(told("bounded", result), "");
  Points x = simulator->positions(0);
  x.col(x.cols() - 1) += Vec3(12.0 * scene.size(), 0.0, 0.0);
  simulator->setPositions(0, x, Points::Zero(3, x.cols()));
  EXPECT_NE(told("bounded", result), "");
}

// What is thrown has the energy of its speed, and never more, in touch or not.
TEST_F(Criteria, SeeEnergyThatAFallMakes) {
  scene.start = Start::kThrown;
  scene.thrown = 0.5;
  scene.leave = 0;
  const auto energy = checkEnergy(scene, *simulator);
  energy->placed(*simulator);
  const double thrown = 0.5 * 1000.0 * scene.organs.front().size.prod() * 0.25;  // [J]
  sim::StepResult result = lockstep->result();
  result.report.kinetic_energy = 0.9 * thrown;
  result.contacts.resize(1);
  EXPECT_EQ(energy->check(cycle(result)), "");
  EXPECT_EQ(energy->finish(), "");
  result.report.elastic_energy = 0.2 * thrown;
  energy->check(cycle(result));
  EXPECT_NE(energy->finish(), "");
}

// A middle node that is pulled past a corner turns the element over there; its volume stays
// positive, and so does what integration points see, for a while.
TEST(QuadraticCorners, AreSeenWhereTheyCurl) {
  mesh::TetMesh linear;
  linear.points = (Points(3, 4) << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1).finished();
  linear.tets = Eigen::Vector4i(0, 1, 2, 3);
  const mesh::CellMesh rest = mesh::cellsOf(mesh::toQuadratic(linear));
  ASSERT_TRUE(areQuadraticTets(rest));
  Points x = 2.0 * rest.points;
  EXPECT_NEAR(leastAtCorners(rest, x), 8.0, 1e-12);
  x = rest.points;
  x(0, rest.cells(4, 0)) = 0.2;  // of the edge from 0 to 1: det F at 0 is 4 * 0.2 - 1
  EXPECT_NEAR(leastAtCorners(rest, x), -0.2, 1e-12);
  // det F = 1 - 4 (0.5 - 0.2) (w_0 - w_1), where w_0 - w_1 is 1/sqrt(5) at the point near 0.
  EXPECT_NEAR(leastAtQuadraturePoints(rest, x), 1.0 - 1.2 / std::sqrt(5.0), 1e-12);
  x(0, rest.cells(4, 0)) = -0.2;
  EXPECT_NEAR(leastAtQuadraturePoints(rest, x), 1.0 - 2.8 / std::sqrt(5.0), 1e-12);
}

TEST_F(Criteria, SeeEnergyThatGrows) {
  sim::StepResult result = play(40);
  result.contacts.clear();
  EXPECT_EQ(told("energy", result), "");
  result.report.kinetic_energy += 1e-3;
  std::string wrong = told("energy", result);
  if (wrong.empty()) wrong = all.at("energy")->finish();
  EXPECT_NE(wrong, "");
}

TEST_F(Criteria, CompareNoEnergyAcrossAPutBack) {
  sim::StepResult result = play(40);
  result.contacts.clear();
  EXPECT_EQ(told("energy", result), "");
  result.report.kinetic_energy += 1e-3;
  result.report.recovery = static_cast<int>(tissue::Recovery::kPutBack);
  EXPECT_EQ(told("energy", result), "");
  EXPECT_EQ(all.at("energy")->finish(), "");
}

// In a live run the machine may be too slow for the last cycle: what is in place is at rest.
TEST_F(Criteria, AskOfACycleThatWasCutShortOnlyWhereItsBodiesAre) {
  for (const bool live : {false, true}) {
    scene.live = live;
    const auto rest = checkRest(scene, *simulator);
    sim::StepResult result;
    result.report.status = solver::SolveStatus::kDeadline;
    rest->check(cycle(result));
    EXPECT_EQ(rest->finish().empty(), live);
    const Points x = simulator->positions(0);
    Points off = x;
    off(2, off.cols() - 1) += 1e-3 * scene.size();
    simulator->setPositions(0, off, Points::Zero(3, x.cols()));
    EXPECT_NE(rest->finish(), "");
    simulator->setPositions(0, x, Points::Zero(3, x.cols()));
  }
}

TEST_F(Criteria, LetSpringsLieInsideOutWhereTheyAreToldTo) {
  scene.organs.front().model = "mass_spring";
  const auto rest = checkRest(scene, *simulator);
  sim::StepResult result = play(scene.trajectory.t.size());
  Points x = simulator->positions(0);
  x.row(2) *= -1.0;
  simulator->setPositions(0, x, Points::Zero(3, x.cols()));
  rest->check(cycle(result));
  EXPECT_NE(rest->finish(), "");
  result.report.status = solver::SolveStatus::kInverted;
  rest->check(cycle(result));
  EXPECT_EQ(rest->finish(), "");
  scene.organs.front().model = "cloth";  // which has no inside
  const auto of_sheet = checkRest(scene, *simulator);
  result.report.status = solver::SolveStatus::kConverged;
  of_sheet->check(cycle(result));
  EXPECT_EQ(of_sheet->finish(), "");
  result.report.status = solver::SolveStatus::kIterationLimit;
  of_sheet->check(cycle(result));
  EXPECT_NE(of_sheet->finish(), "");
}

TEST_F(Criteria, SeeWhatDoesNotComeBack) {
  play(scene.trajectory.t.size());
  Points x = simulator->positions(0);
  x(0, x.cols() - 1) += 1.1e-4 * scene.size();
  simulator->setPositions(0, x, Points::Zero(3, x.cols()));
  EXPECT_NE(all.at("rest")->finish(), "");
}

TEST_F(Criteria, SeeACycleThatStalls) {
  sim::StepResult result = play(10);
  result.report.phases[Phase::kAssembly] = 30.0;
  EXPECT_EQ(told("time", result), "");
  EXPECT_NE(all.at("time")->finish(), "");
}

}  // namespace
}  // namespace palpate::torture::criteria_test
