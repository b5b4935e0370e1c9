// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <sstream>

#include "palpate/io/trajectory.h"
#include "run_cli.h"
#include "sim/slab_scene.h"
#include "support/contains.h"

namespace palpate::replay_command_test {
namespace {

using test::contains;
using test::runCli;

// The table without its column of wall times.
std::string withoutTimes(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line, result;
  int skip = -1;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (int column = 0; std::getline(cells, cell, ','); ++column) {
      if (cell == "step_ms") skip = column;
      if (column != skip) result += cell + ",";
    }
    result += "\n";
  }
  return result;
}

class ReplayCommand : public ::testing::Test {
 protected:
  ReplayCommand() {
    formats::Trajectory trajectory;
    trajectory.columns = {"x", "y", "z", "roll", "pitch", "yaw"};
    const auto press = test::SlabScene::press();
    trajectory.values.resize(6, static_cast<Eigen::Index>(press.size()));
    for (std::size_t k = 0; k < press.size(); ++k) {
      trajectory.t.push_back(0.01 * static_cast<double>(k));
      trajectory.values.col(static_cast<Eigen::Index>(k)) = press[k];
    }
    io::writeTrajectory(file("T.csv"), trajectory);
  }
  std::string file(const std::string& name) const { return slab.folder().path(name); }
  test::CliResult replay(const std::string& out, const std::string& more = "") const {
    return runCli("replay '" + slab.file() + "' --trajectory '" + file("T.csv") + "' --out '" +
                  file(out) + "' " + more);
  }
  test::SlabScene slab;
};

TEST_F(ReplayCommand, SameInputsSameBytesWhateverTheThreads) {
  ASSERT_EQ(replay("a.csv").status, 0);
  ASSERT_EQ(replay("b.csv").status, 0);
  ASSERT_EQ(replay("c.csv", "--threads 2").status, 0);
  const std::string a = withoutTimes(test::fileBytes(file("a.csv")));
  EXPECT_EQ(a, withoutTimes(test::fileBytes(file("b.csv"))));
  EXPECT_EQ(a, withoutTimes(test::fileBytes(file("c.csv"))));
  EXPECT_EQ(a.substr(0, a.find('\n')),
            "t,fx,fy,fz,tx,ty,tz,contacts,max_penetration,newton_iterations,cg_iterations,residual,"
            "min_jacobian,kinetic_energy,elastic_energy,status,recovery,skipped,mesh_error,"
            "nodes,mesh_changes,walk_steps,tree_queries,state_hash,");
  EXPECT_EQ(std::count(a.begin(), a.end(), '\n'), 152);
}

// In another process, from the row at which the first one ended.
TEST_F(ReplayCommand, GoesOnFromASavedStateWithTheSameBytes) {
  ASSERT_EQ(replay("whole.csv", "--save-state '" + file("whole.state") + "'").status, 0);
  const formats::Trajectory all = formats::readTrajectory(file("T.csv"));
  const std::size_t cut = 60, size = all.t.size();
  const auto part = [&](std::size_t begin, std::size_t end) {
    formats::Trajectory some;
    some.columns = all.columns;
    some.t.assign(all.t.begin() + static_cast<std::ptrdiff_t>(begin),
                  all.t.begin() + static_cast<std::ptrdiff_t>(end));
    some.values = all.values.middleCols(static_cast<Eigen::Index>(begin),
                                        static_cast<Eigen::Index>(end - begin));
    io::writeTrajectory(file("T.csv"), some);
  };
  part(0, cut + 1);
  ASSERT_EQ(replay("first.csv", "--save-state '" + file("cut.state") + "'").status, 0);
  part(cut, size);
  ASSERT_EQ(replay("second.csv", "--initial-state '" + file("cut.state") + "' --save-state '" +
                                     file("end.state") + "'")
                .status,
            0);
  const std::string first = withoutTimes(test::fileBytes(file("first.csv")));
  const std::string second = withoutTimes(test::fileBytes(file("second.csv")));
  EXPECT_EQ(first + second.substr(second.find('\n') + 1),
            withoutTimes(test::fileBytes(file("whole.csv"))));
  EXPECT_EQ(test::fileBytes(file("end.state")), test::fileBytes(file("whole.state")));

  slab.folder().write("bad.state", "nonsense");
  const test::CliResult refused = replay("bad.csv", "--initial-state '" + file("bad.state") + "'");
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(contains(refused.err, "is no state")) << refused.err;
}

TEST_F(ReplayCommand, ProfileSaysWhereTheTimeWentAndWhetherTheSceneIsTooHeavy) {
  const test::CliResult plain = replay("a.csv");
  EXPECT_FALSE(contains(plain.out, "too heavy"));
  const test::CliResult light = replay("b.csv", "--profile");
  ASSERT_EQ(light.status, 0);
  for (const char* word :
       {"phase          median ms    p99 ms   share", "contact", "forces", "assembly",
        "linear_solve", "line_search", "Newton iterations per step", "sleeping_organs",
        "is the scene too heavy for 100 Hz?", "rate possible: ", "costliest: "}) {
    EXPECT_TRUE(contains(light.out, word)) << word << "\n" << light.out;
  }
  // The profile is of the clock, the table is not.
  EXPECT_EQ(withoutTimes(test::fileBytes(file("a.csv"))),
            withoutTimes(test::fileBytes(file("b.csv"))));

  slab.folder().write("heavy.yaml", test::fileBytes(slab.file()) + "rates: {simulation: 10000}\n");
  const test::CliResult heavy =
      runCli("replay '" + file("heavy.yaml") + "' --profile --trajectory '" + file("T.csv") +
             "' --out '" + file("c.csv") + "'");
  ASSERT_EQ(heavy.status, 0) << heavy.err;
  EXPECT_TRUE(contains(heavy.out, "yes, by a factor of "));
  EXPECT_TRUE(contains(heavy.out, "give organ slab a coarser mesh"));
  EXPECT_TRUE(contains(heavy.out, "set solver.step: "));
}

TEST_F(ReplayCommand, WritesPictures) {
  ASSERT_EQ(replay("a.csv", "--vtu '" + file("pictures") + "' --every 50").status, 0);
  EXPECT_TRUE(std::filesystem::exists(file("pictures/slab_000050.vtu")));
  EXPECT_TRUE(std::filesystem::exists(file("pictures/slab_000150.vtu")));
}

TEST_F(ReplayCommand, SaysWhichJointsAreMissingOrUnknown) {
  slab.folder().write("T.csv", "t,x,y,z,roll,pitch,jaw\n0,0,0,0,0,0,0\n");
  const test::CliResult result = replay("a.csv");
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(contains(result.err, "yaw: this joint has no column"));
  EXPECT_TRUE(contains(result.err, "column jaw"));
  EXPECT_TRUE(contains(result.err, "did you mean yaw?"));
}

TEST_F(ReplayCommand, BadFilesAreBadInput) {
  EXPECT_EQ(runCli("replay nowhere.yaml --trajectory x.csv --out y.csv").status, 2);
  slab.folder().write("T.csv", "t,x,y,z,roll,pitch,yaw\n0,0,0,nan,0,0,0\n");
  EXPECT_EQ(replay("a.csv").status, 2);
}

}  // namespace
}  // namespace palpate::replay_command_test
