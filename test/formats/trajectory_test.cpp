// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/formats/trajectory.h"

#include <gtest/gtest.h>

#include <random>

#include "palpate/io/trajectory.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::formats::trajectory_test {
namespace {

using test::hasProblem;

class TrajectoryFile : public ::testing::Test {
 protected:
  Trajectory read(const std::string& text) const {
    return readTrajectory(folder_.write("t.csv", text));
  }
  std::vector<Problem> problemsOfText(const std::string& text) const {
    return test::problemsOf([&] { read(text); });
  }
  test::TempFolder folder_;
};

TEST_F(TrajectoryFile, Reads) {
  const Trajectory t = read("# by hand\nt,a,left/b\n0,1,2\n\n0.5, -1.5 ,2e-3\n");
  EXPECT_EQ(t.columns, (std::vector<std::string>{"a", "left/b"}));
  EXPECT_EQ(t.t, (std::vector<double>{0.0, 0.5}));
  EXPECT_EQ(t.values, (Eigen::Matrix2d() << 1.0, -1.5, 2.0, 2e-3).finished());
}

TEST_F(TrajectoryFile, LineEndsDoNotMatter) {
  const Trajectory unix_ends = read("t,a\n0,1\n1,2\n");
  for (const char* text :
       {"t,a\r\n0,1\r\n1,2\r\n", "t,a\n0,1\n1,2", "\xEF\xBB\xBFt,a\n0,1\n1,2\n"}) {
    const Trajectory other = read(text);
    EXPECT_EQ(other.columns, unix_ends.columns);
    EXPECT_EQ(other.t, unix_ends.t);
    EXPECT_EQ(other.values, unix_ends.values);
  }
}

TEST_F(TrajectoryFile, ComesBackBitForBit) {
  std::mt19937 rng(20240229);
  std::normal_distribution<double> normal;
  Trajectory written;
  written.columns = {"x", "y", "z"};
  written.values.resize(3, 500);
  for (int i = 0; i < 500; ++i) {
    written.t.push_back(i / 300.0);
    for (int j = 0; j < 3; ++j) written.values(j, i) = normal(rng);
  }
  io::writeTrajectory(folder_.path("t.csv"), written);
  const Trajectory back = readTrajectory(folder_.path("t.csv"));
  EXPECT_EQ(back.columns, written.columns);
  EXPECT_EQ(back.t, written.t);
  EXPECT_EQ(back.values, written.values);
}

TEST_F(TrajectoryFile, FullDiskIsToldOf) {
  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "needs /dev/full to imitate a disk without room; this system has none";
  EXPECT_TRUE(
      hasProblem(test::problemsOf([] {
                   io::writeTrajectory("/dev/full", {{"a"}, {0.0}, Eigen::MatrixXd::Zero(1, 1)});
                 }),
                 "", "cannot be written"));
}

TEST_F(TrajectoryFile, NothingInIt) {
  EXPECT_TRUE(hasProblem(problemsOfText(""), "", "no first row"));
  EXPECT_TRUE(hasProblem(problemsOfText("# only this\n"), "", "no first row"));
  EXPECT_TRUE(hasProblem(problemsOfText("t,a\n"), "", "no rows"));
  EXPECT_TRUE(hasProblem(test::problemsOf([&] { readTrajectory(folder_.path("absent")); }), "",
                         "no such file"));
}

TEST_F(TrajectoryFile, FirstRow) {
  EXPECT_TRUE(hasProblem(problemsOfText("time,a\n0,1\n"), "line 1, column 1", "named t"));
  EXPECT_TRUE(hasProblem(problemsOfText("t\n0\n"), "line 1", "at least one joint"));
  EXPECT_TRUE(hasProblem(problemsOfText("t,a,a\n0,1,1\n"), "line 1, column 3", "stands twice"));
  EXPECT_TRUE(hasProblem(problemsOfText("t,a,\n0,1,1\n"), "line 1, column 3", "has no name"));
  EXPECT_TRUE(hasProblem(problemsOfText("0,1\n1,1\n"), "line 1, column 1", "named t"));
}

TEST_F(TrajectoryFile, Rows) {
  EXPECT_TRUE(hasProblem(problemsOfText("t,a\n0,x\n"), "line 2, a", "finite number"));
  EXPECT_TRUE(hasProblem(problemsOfText("t,a\n0,nan\n"), "line 2, a", "finite number"));
  EXPECT_TRUE(hasProblem(problemsOfText("t,a\n0,inf\n"), "line 2, a", "finite number"));
  EXPECT_TRUE(hasProblem(problemsOfText("t,a\n0,\n"), "line 2, a", "finite number"));
  EXPECT_TRUE(hasProblem(problemsOfText("t,a\nnan,1\n"), "line 2, t", "finite number"));
  EXPECT_TRUE(hasProblem(problemsOfText("t,a\n0,1\n1,1,1\n"), "line 3", "must have 2"));
  EXPECT_TRUE(hasProblem(problemsOfText("t,a\n0,1\n1\n"), "line 3", "must have 2"));
  EXPECT_TRUE(hasProblem(problemsOfText("t,a\n0,1\n# x\n0,1\n"), "line 4, t", "larger"));
  EXPECT_TRUE(hasProblem(problemsOfText("t,a\n0,1\n-1,1\n"), "line 3, t", "larger"));
}

TEST_F(TrajectoryFile, ManyProblemsAreToldInOneMessageOfModestLength) {
  std::string text = "t,a\n";
  for (int i = 0; i < 1000; ++i) text += std::to_string(i) + ",x\n";
  const std::size_t count = problemsOfText(text).size();
  EXPECT_GT(count, 1u);
  EXPECT_LE(count, 20u);
}

// Names are compared, problems are kept: for a file of any width that must not take long, or much.
TEST_F(TrajectoryFile, ManyColumnsAreRefusedAtOnce) {
  const auto row = [](const std::string& cell, int count) {
    std::string text = "t";
    for (int i = 0; i < count; ++i) text += "," + cell + std::to_string(i);
    return text + "\n";
  };
  const auto problems = problemsOfText(row("q", 1000000) + row("", 1000000));
  EXPECT_EQ(problems.size(), 1U);
  EXPECT_TRUE(hasProblem(problems, "line 1", "must have at most 2000"));
  EXPECT_EQ(problemsOfText(row("q", 1999) + row("x", 1999)).size(), 20U);
  EXPECT_EQ(read(row("q", 1999) + "0" + row("0.", 1999).substr(1)).columns.size(), 1999U);
}

}  // namespace
}  // namespace palpate::formats::trajectory_test
