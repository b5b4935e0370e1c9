// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "palpate/formats/tet_io.h"
#include "run_cli.h"
#include "support/contains.h"

namespace palpate::bench_command_test {
namespace {

using test::contains;
using test::runCli;

constexpr const char* kCube = "bench --scene cube --tets 162 --duration 0.06 --repeat 2 ";

class BenchCommand : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder.path(name); }
  test::CliResult cube(const std::string& out, const std::string& more = "") const {
    return runCli(kCube + ("--out '" + path(out) + "' ") + more);
  }
  test::TempFolder folder;
};

TEST_F(BenchCommand, ListsScenesWithoutOne) {
  const test::CliResult result = runCli("bench");
  EXPECT_EQ(result.status, 0);
  for (const char* scene : {"cube", "beam", "flap", "inclusion", "capsule", "rest", "liver_500"}) {
    EXPECT_TRUE(contains(result.out, scene)) << result.out;
  }
}

TEST_F(BenchCommand, WritesWhatItMeasured) {
  const test::CliResult result = cube("a");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "162 tetrahedra, 64 nodes"));
  const std::string summary = test::fileBytes(path("a/summary.json"));
  EXPECT_TRUE(contains(summary, "\"solver.step\": \"0.01\""));
  EXPECT_TRUE(contains(summary, "\"same_bits\": true"));
  EXPECT_TRUE(contains(summary, "\"frame_times\": [0.02, 0.04, 0.06]"));
  const std::string forces = test::fileBytes(path("a/forces.csv"));
  EXPECT_EQ(std::count(forces.begin(), forces.end(), '\n'), 7);
  EXPECT_EQ(test::fileBytes(path("a/displacements.bin")).size(), 3u * 64u * 3u * sizeof(double));
  EXPECT_EQ(formats::readTetMesh(path("a/mesh.vtu")).numPoints(), 64);
}

// Six cycles a repeat: the repeats that were asked for, and more where they are too few.
TEST_F(BenchCommand, RepeatsUntilThereAreEnoughCycles) {
  ASSERT_EQ(cube("a").status, 0);
  EXPECT_TRUE(contains(test::fileBytes(path("a/summary.json")), "\"repeats\": 2,"));
  ASSERT_EQ(cube("b", "--cycles 25").status, 0);
  const std::string summary = test::fileBytes(path("b/summary.json"));
  EXPECT_TRUE(contains(summary, "\"repeats\": 5,")) << summary;
  EXPECT_TRUE(contains(summary, "\"pooled\": {\"median_ms\": "));
  ASSERT_EQ(cube("c", "--cycles 100000 --seconds 1e-9").status, 0);
  EXPECT_TRUE(contains(test::fileBytes(path("c/summary.json")), "\"repeats\": 1,"));
}

TEST_F(BenchCommand, GradesAMeshWhereTheToolGoes) {
  const auto nodes = [&](const std::string& out, const std::string& more) {
    const test::CliResult result =
        runCli("bench --duration 0.02 --repeat 1 --out '" + path(out) + "' --scene " + more);
    EXPECT_EQ(result.status, 0) << result.err;
    return formats::readTetMesh(path(out + "/mesh.vtu")).points;
  };
  const auto near = [](const Points& points, const Vec3& place) {
    return ((points.colwise() - place).colwise().norm().array() < 0.015).count();
  };
  const Points graded = nodes("a", "cube --finest 0.005 --edge-length 0.03");
  EXPECT_GT(near(graded, {0.055, 0.05, 0.1}), 10 * near(graded, {0.05, 0.05, 0.0}));
  const Points flap = nodes("b", "flap --finest 0.003");
  EXPECT_GT(near(flap, {0.04, 0.02, 0.003}), 0);
  EXPECT_EQ(runCli("bench --scene cube --finest 0.005 --tets 100").status, 2);
  EXPECT_EQ(runCli("bench --scene beam --finest 0.005").status, 2);
  EXPECT_EQ(runCli("bench --scene cube --finest 0").status, 2);
}

// The mesh is as coarse as without when the ball is away, has more nodes where it comes, and the
// force is smaller for it.
TEST_F(BenchCommand, FollowsTheToolWithItsMesh) {
  const auto column = [&](const std::string& out, int wanted) {
    std::istringstream rows(test::fileBytes(path(out + "/forces.csv")));
    std::vector<double> values;
    std::string line, cell;
    std::getline(rows, line);
    while (std::getline(rows, line)) {
      std::istringstream cells(line);
      for (int k = 0; k <= wanted; ++k) std::getline(cells, cell, ',');
      values.push_back(std::stod(cell));
    }
    return values;
  };
  ASSERT_EQ(cube("a").status, 0);
  const test::CliResult adapted = cube("b", "--adapt 0.006");
  ASSERT_EQ(adapted.status, 0) << adapted.err;
  EXPECT_TRUE(contains(adapted.out, "162 tetrahedra, 64 nodes"));
  const std::vector<double> nodes = column("b", 15), changes = column("b", 16);
  EXPECT_EQ(nodes.front(), 64.0);
  EXPECT_GT(nodes.back(), 200.0);
  EXPECT_EQ(column("a", 15).back(), 64.0);
  EXPECT_GE(std::accumulate(changes.begin(), changes.end(), 0.0), 1.0);
  EXPECT_LT(column("b", 3).back(), 0.9 * column("a", 3).back());
  EXPECT_LT(column("b", 14).back(), 0.9 * column("a", 14).back());
  EXPECT_EQ(test::fileBytes(path("b/displacements.bin")).size(), 3u * 64u * 3u * sizeof(double));
  ASSERT_EQ(cube("c", "--adapt 0.006 --growth 0.6").status, 0);
  EXPECT_GT(column("c", 15).back(), nodes.back());
  EXPECT_EQ(cube("d", "--adapt 0").status, 2);
  EXPECT_EQ(cube("d", "--adapt 0.006 --element tet10").status, 0);
  EXPECT_EQ(cube("e", "--adapt 0.006 --method linear_precomputed").status, 2);
}

// The shipped liver adapts; with a mesh that was asked for it does not, unless that is asked for
// too.
TEST_F(BenchCommand, LeavesAMeshThatWasAskedForAsItIs) {
  const auto changes = [&](const std::string& arguments) {
    runCli("bench --repeat 1 --out '" + path("liver") + "' --scene " + arguments);
    std::istringstream rows(test::fileBytes(path("liver/forces.csv")));
    std::string line;
    int sum = 0;
    std::getline(rows, line);
    while (std::getline(rows, line)) {
      sum += line.substr(line.rfind(',') + 1) != "0";
    }
    return sum;
  };
  EXPECT_GT(changes("liver --duration 0.6"), 0);
  EXPECT_EQ(changes("liver --edge-length 0.03 --duration 0.6"), 0);
  EXPECT_EQ(changes("liver --edge-length 0.03 --finest 0.01 --duration 0.6"), 0);
  EXPECT_GT(changes("liver --edge-length 0.03 --adapt 0.01 --duration 0.6"), 0);
  EXPECT_EQ(changes("liver_150 --duration 0.6"), 0);
}

// The ball is 2 mm inside at the end: the tissue pushes it up.
TEST_F(BenchCommand, TheToolFeelsTheTissue) {
  ASSERT_EQ(cube("a").status, 0);
  std::string forces = test::fileBytes(path("a/forces.csv"));
  forces.pop_back();
  std::istringstream last(forces.substr(forces.rfind('\n') + 1));
  std::string cell;
  std::vector<double> row;
  for (int k = 0; k < 4 && std::getline(last, cell, ','); ++k) row.push_back(std::stod(cell));
  EXPECT_DOUBLE_EQ(row[0], 0.06);
  EXPECT_GT(row[3], 0.05);
  EXPECT_LT(row[3], 1.0);
}

TEST_F(BenchCommand, SameBitsInTwoRunsAndForTwoThreads) {
  ASSERT_EQ(cube("a").status, 0);
  ASSERT_EQ(cube("b").status, 0);
  ASSERT_EQ(cube("c", "--threads 2").status, 0);
  for (const char* file : {"/forces.csv", "/displacements.bin"}) {
    const std::string a = test::fileBytes(path(std::string("a") + file));
    EXPECT_EQ(a, test::fileBytes(path(std::string("b") + file)));
    EXPECT_EQ(a, test::fileBytes(path(std::string("c") + file)));
  }
}

TEST_F(BenchCommand, TakesTheSettingsThatAreGiven) {
  ASSERT_EQ(cube("a",
                 "--set solver.step=0.02 --set contact.stiffness=1e6 --threads 2 "
                 "--poisson-ratio 0.49 --element tet4")
                .status,
            0);
  const std::string summary = test::fileBytes(path("a/summary.json"));
  EXPECT_TRUE(contains(summary, "\"element\": \"tet4\""));
  EXPECT_TRUE(contains(summary, "\"poisson_ratio\": 0.49"));
  EXPECT_TRUE(contains(summary, "\"solver.step\": \"0.02\""));
  EXPECT_TRUE(contains(summary, "\"solver.threads\": \"2\""));
  EXPECT_TRUE(contains(summary, "\"contact.stiffness\": \"1000000\""));
  EXPECT_TRUE(contains(summary, "\"cycles\": 3"));
}

TEST_F(BenchCommand, SaysAllThatIsWrongWithTheSettings) {
  const test::CliResult result =
      runCli(kCube + std::string("--set solver.tolerence=1e-3 --set solver.step=1 "
                                 "--integrator euler"));
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(contains(result.err, "did you mean solver.tolerance?"));
  EXPECT_TRUE(contains(result.err, "solver.step = 1: must be in (0, 0.1]"));
  EXPECT_TRUE(contains(result.err, "solver.integrator = euler: must be one of backward_euler"));
}

TEST_F(BenchCommand, BadOptionsAreBadInput) {
  const test::CliResult scene = runCli("bench --scene cubes");
  EXPECT_EQ(scene.status, 2);
  EXPECT_TRUE(contains(scene.err, "did you mean cube?"));
  EXPECT_EQ(runCli(kCube + std::string("--set solver.step")).status, 2);
  EXPECT_EQ(runCli(kCube + std::string("--duration 0")).status, 2);
  EXPECT_EQ(runCli(kCube + std::string("--poisson-ratio 0.5")).status, 2);
  EXPECT_EQ(runCli(kCube + std::string("--element tet5")).status, 2);
  EXPECT_EQ(runCli(kCube + std::string("--edge-length 0.01")).status, 2);
}

TEST_F(BenchCommand, SaysWhereItCannotPutItsFiles) {
  const test::CliResult result = runCli(kCube, "TMPDIR=/nowhere");
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(contains(result.err, "TMPDIR = /nowhere")) << result.err;
}

TEST_F(BenchCommand, SmallRunsEverySceneThatIsABox) {
  const test::CliResult result = runCli("bench --small");
  EXPECT_EQ(result.status, 0) << result.err;
  for (const char* scene : {"cube", "inclusion", "capsule", "flap", "beam", "rest"}) {
    EXPECT_TRUE(contains(result.out, scene)) << result.out;
  }
}

}  // namespace
}  // namespace palpate::bench_command_test
