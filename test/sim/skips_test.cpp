// SPDX-License-Identifier: GPL-3.0-or-later
// What is left out does not change what the hand feels, is counted, and can be switched off.
#include "palpate/tissue/skips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "palpate/sim/simulator.h"
#include "slab_scene.h"
#include "support/contains.h"
#include "support/input_error.h"
#include "support/source_folder.h"

namespace palpate::sim::skips_test {
namespace {

constexpr double kStep = 0.01;

TEST(Skips, AreOnUnlessTheSceneSaysOtherwise) {
  const test::SlabScene slab;
  const scene::SkipConfig usual = slab.scene().solver.skip;
  for (const tissue::Skip& skip : tissue::skips()) {
    if (!skip.key) continue;
    EXPECT_TRUE(usual.*skip.on) << skip.key;
    const scene::SkipConfig off =
        slab.scene("solver: {skip: {" + std::string(skip.key) + ": false}}").solver.skip;
    for (const tissue::Skip& other : tissue::skips()) {
      if (!other.key) continue;
      EXPECT_EQ(off.*other.on, &other != &skip) << skip.key << " " << other.key;
    }
  }
  EXPECT_TRUE(
      test::hasProblem(test::problemsOf([&] { slab.scene("solver: {skip: {sleepy: true}}"); }),
                       "solver.skip.sleepy", "sleeping"));
}

TEST(Skips, AreTheOnesThatTheArchitecturePageLists) {
  const auto code = [](const std::string& prefix, const char* name) {
    return name ? "`" + prefix + name + "`" : std::string("-");
  };
  std::string table =
      "| counter | switch below `solver.skip` | what is left out |\n|---|---|---|\n";
  for (const tissue::Skip& skip : tissue::skips()) {
    table += "| " + code("skipped_", skip.counter) + " | " + code("", skip.key) + " | " + skip.doc +
             " |\n";
  }
  const std::string page = test::fileBytes(test::sourceFolder() + "/docs/architecture.md");
  EXPECT_NE(page.find(table + "\n"), std::string::npos) << "must have this table:\n" << table;
}

TEST(Skips, EveryCounterIsSummedAndInTheMessage) {
  const std::string message = test::fileBytes(test::sourceFolder() + "/msg/StepReport.msg");
  tissue::SkipCounters ones, sum;
  std::int64_t total = 0;
  for (const tissue::Skip& skip : tissue::skips()) {
    if (!skip.count) continue;
    EXPECT_TRUE(test::contains(message, " skipped_" + std::string(skip.counter) + " "))
        << skip.counter;
    ones.*skip.count = 1;
    total += skip.in_total;
  }
  sum += ones;
  sum += ones;
  for (const tissue::Skip& skip : tissue::skips()) {
    if (!skip.count) continue;
    EXPECT_EQ(sum.*skip.count, 2) << skip.counter;
  }
  EXPECT_EQ(sum.total(), 2 * total);
}

// A run over the slab: at rest, pressed, at rest again.
struct Outcome {
  std::vector<Vec3> forces;
  Points positions;
  tissue::SkipCounters skipped;
  double seconds_per_cycle = 0.0;  // the fastest of the last ones
};

Outcome run(const scene::Scene& scene) {
  Simulator simulator(scene);
  Outcome run;
  std::vector<Eigen::VectorXd> joints(30, Eigen::VectorXd::Zero(6));
  const std::vector<Eigen::VectorXd> press = test::SlabScene::press();
  joints.insert(joints.end(), press.begin(), press.end());
  joints.resize(joints.size() + 30, press.back());
  run.seconds_per_cycle = 1.0;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const StepResult& result = simulator.step({simulator.linkPoses(0, joints[k])}, kStep);
    EXPECT_TRUE(result.report.ok());
    run.forces.push_back(result.instruments[0].spatial.force);
    run.skipped += result.report.skipped;
    if (k > 20 && k < 30) {
      run.seconds_per_cycle = std::min(run.seconds_per_cycle, result.report.phases.cycle());
    }
  }
  run.positions = simulator.positions(0);
  return run;
}

class SkipOf : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Simulation, SkipOf,
                         ::testing::Values("far_tools", "sleeping", "distant_samples",
                                           "inactive_samples", "viscous_terms",
                                           "unchanged_stiffness"),
                         [](const auto& name) { return name.param; });

TEST_P(SkipOf, ChangesNothingThatIsFelt) {
  const auto skip =
      std::find_if(tissue::skips().begin(), tissue::skips().end(),
                   [](const tissue::Skip& s) { return s.key && GetParam() == s.key; });
  ASSERT_NE(skip, tissue::skips().end());
  const test::SlabScene slab;
  scene::Scene scene = slab.scene();
  const Outcome on = run(scene);
  scene.solver.skip.*skip->on = false;
  const Outcome off = run(scene);
  EXPECT_GT(on.skipped.*skip->count, 0);
  EXPECT_EQ(off.skipped.*skip->count, 0);
  double peak = 0.0, difference = 0.0;
  for (std::size_t k = 0; k < on.forces.size(); ++k) {
    peak = std::max(peak, off.forces[k].norm());
    difference = std::max(difference, (on.forces[k] - off.forces[k]).norm());
  }
  EXPECT_GT(peak, 0.2);
  EXPECT_LT(difference, 2e-3 * peak);
  EXPECT_LT((on.positions - off.positions).cwiseAbs().maxCoeff(), 1e-5);
}

// The switch reaches the tissue: an organ of two parts, of which the probe touches one.
TEST(Skips, AnOrganOfTwoPartsIsSolvedPartByPart) {
  const test::SlabScene slab;
  mesh::TetMesh two = mesh::boxMesh(Vec3(0.1, 0.1, 0.04), Eigen::Vector3i(4, 4, 2));
  const Eigen::Index n = two.numPoints(), m = two.numTets();
  two.points.conservativeResize(3, 2 * n);
  two.points.rightCols(n) = two.points.leftCols(n).colwise() + Vec3(0.2, 0.0, 0.0);
  two.tets.conservativeResize(4, 2 * m);
  two.tets.rightCols(m) = two.tets.leftCols(m).array() + static_cast<int>(n);
  formats::writeVtu(slab.folder().path("slab.vtu"), two, {}, {});
  scene::Scene scene = slab.scene();
  const Outcome on = run(scene);
  scene.solver.skip.islands = false;
  const Outcome off = run(scene);
  EXPECT_GT(on.skipped.sleeping_islands, 150);
  EXPECT_EQ(off.skipped.sleeping_islands, 0);
  for (std::size_t k = 0; k < on.forces.size(); ++k) {
    EXPECT_LT((on.forces[k] - off.forces[k]).norm(), 2e-3);
  }
}

TEST(Skips, ARestingSceneCostsNextToNothing) {
  const test::SlabScene slab;
  scene::Scene scene = slab.scene();
  const double asleep = run(scene).seconds_per_cycle;
  scene.solver.skip.sleeping = false;
  const double awake = run(scene).seconds_per_cycle;
  std::printf("a cycle at rest: %.1f us asleep, %.1f us awake\n", 1e6 * asleep, 1e6 * awake);
  EXPECT_LT(asleep, 1e-4);  // 1 % of a core at 100 Hz
  EXPECT_LT(asleep, 0.5 * awake);
}

}  // namespace
}  // namespace palpate::sim::skips_test
