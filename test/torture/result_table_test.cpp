// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/torture/result_table.h"

#include <gtest/gtest.h>

#include <string>

#include "palpate/base/error.h"
#include "palpate/torture/torture_report.h"
#include "support/contains.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::torture::result_table_test {
namespace {

Outcome failed() {
  Outcome outcome;
  outcome.cycles = 7;
  outcome.unsolved = 2;
  outcome.longest_ms = 5100.0;
  outcome.failures = {{"rest", 6, "off by 3, \"quoted\"\nand more"}, {"time", 6, "slow"}};
  return outcome;
}

TEST(ResultTable, BringsBackWhatWasWritten) {
  const test::TempFolder folder;
  const std::string file = folder.path("results_1_of_1.csv");
  appendResult(file, resultLine(drawScene(1, 3), failed()));
  appendResult(file, resultLine(drawScene(1, 4), Outcome()));
  appendResult(file, crashLine(drawScene(1, 5)));
  const std::vector<ResultLine> lines = readResults(folder.path(""));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0].cell("verdict"), "failed");
  EXPECT_EQ(lines[0].cell("criteria"), "rest time");
  EXPECT_EQ(lines[0].number("unsolved"), 2.0);
  EXPECT_EQ(lines[1].cell("verdict"), "passed");
  EXPECT_EQ(lines[1].cell("category"), "pinch");
  EXPECT_EQ(lines[2].cell("criteria"), "crash");
  EXPECT_EQ(numbersDone(lines, 1), (std::set<int>{3, 4, 5}));
  EXPECT_TRUE(numbersDone(lines, 2).empty());
}

TEST(ResultTable, IsReadAsItWasWritten) {
  const test::TempFolder folder, copy;
  appendResult(folder.path("results_1_of_2.csv"), resultLine(drawScene(1, 4), failed(), "abc"));
  appendResult(folder.path("results_2_of_2.csv"), resultLine(drawScene(1, 3), Outcome(), "abc"));
  const std::string table = resultTable(readResults(folder.path("")));
  copy.write("results.csv", table);
  EXPECT_EQ(resultTable(readResults(copy.path(""))), table);
  EXPECT_EQ(readResults(copy.path("")).at(1).cell("commit"), "abc");
}

// Of what was run before, what did not pass is run again, until it was run by this commit.
TEST(ResultTable, RunsAgainWhatFailedBefore) {
  const test::TempFolder folder;
  Outcome left, refused;
  left.whole = false;
  refused.refused = "too soft";
  const std::string before = folder.path("results.csv");
  appendResult(before, resultLine(drawScene(1, 2), refused, "abc"));
  appendResult(before, resultLine(drawScene(1, 3), failed(), "abc"));
  appendResult(before, resultLine(drawScene(1, 4), Outcome(), "abc"));
  appendResult(before, resultLine(drawScene(1, 5), left, "abc"));
  EXPECT_EQ(numbersAgain(readResults(folder.path("")), 1, "def"), (std::set<int>{3, 5}));
  EXPECT_TRUE(numbersAgain(readResults(folder.path("")), 2, "def").empty());
  const std::string now = folder.path("results_1_of_1.csv");
  appendResult(now, resultLine(drawScene(1, 3), Outcome(), "def"));
  appendResult(now, resultLine(drawScene(1, 5), left, "def"));
  EXPECT_TRUE(numbersAgain(readResults(folder.path("")), 1, "def").empty());
  EXPECT_EQ(readResults(folder.path("")).at(1).cell("verdict"), "passed");
}

// A machine that was switched off, and two parts that did the same scene.
TEST(ResultTable, LeavesOutWhatWasCutOffAndDoubled) {
  const test::TempFolder folder;
  appendResult(folder.path("results_1_of_2.csv"), resultLine(drawScene(1, 3), failed()));
  appendResult(folder.path("results_2_of_2.csv"), resultLine(drawScene(1, 3), Outcome()));
  appendResult(folder.path("results_2_of_2.csv"), resultLine(drawScene(1, 4), Outcome()));
  const std::string bytes = test::fileBytes(folder.path("results_2_of_2.csv"));
  folder.write("results_2_of_2.csv", bytes.substr(0, bytes.size() - 3));
  folder.write("other.csv", "1,2,3\n");
  const std::vector<ResultLine> lines = readResults(folder.path(""));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].cell("verdict"), "passed");
  EXPECT_THROW(readResults(folder.path("nowhere")), InputError);
}

TEST(StabilityPage, CountsAndNamesWhatFails) {
  Outcome refused;
  refused.refused = "scene.yaml: too soft";
  const std::string page = stabilityMarkdown({resultLine(drawScene(1, 3), failed(), "abc"),
                                              resultLine(drawScene(1, 4), Outcome(), "abc"),
                                              resultLine(drawScene(1, 6), refused)});
  EXPECT_TRUE(
      test::contains(page, "3 scenes: 1 passed, 1 failed, 1 refused while loading, 0 left off."));
  EXPECT_TRUE(test::contains(page, "tetrahedra; 1 had a cycle of more than 5 s."));
  EXPECT_TRUE(test::contains(page, "| `inside` | 1 | 0 | 1 | 0 | 0 | 28.6 |"));
  EXPECT_TRUE(test::contains(page, "`palpate torture --seed 1 --only 3` | rest time |"));
  EXPECT_TRUE(test::contains(page, "too soft"));
  EXPECT_TRUE(test::contains(page, "\nCommit -: 1 scenes.\nCommit abc: 2 scenes.\n"));
}

}  // namespace
}  // namespace palpate::torture::result_table_test
