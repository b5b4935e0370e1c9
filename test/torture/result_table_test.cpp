// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/torture/result_table.h"

#include <gtest/gtest.h>

#include <string>

#include "palpate/base/error.h"
#include "palpate/torture/torture_report.h"
#include "support/contains.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::torture {
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
  EXPECT_EQ(lines[0].cell("verdict"), "failed");
  EXPECT_THROW(readResults(folder.path("nowhere")), InputError);
}

TEST(StabilityPage, CountsAndNamesWhatFails) {
  Outcome refused;
  refused.refused = "scene.yaml: too soft";
  const std::string page = stabilityMarkdown({resultLine(drawScene(1, 3), failed()),
                                              resultLine(drawScene(1, 4), Outcome()),
                                              resultLine(drawScene(1, 6), refused)});
  EXPECT_TRUE(
      test::contains(page, "3 scenes: 1 passed, 1 failed, 1 refused while loading, 0 left off."));
  EXPECT_TRUE(test::contains(page, "tetrahedra; 1 had a cycle of more than 5 s."));
  EXPECT_TRUE(test::contains(page, "| `inside` | 1 | 0 | 1 | 0 | 0 | 28.6 |"));
  EXPECT_TRUE(test::contains(page, "`palpate torture --seed 1 --only 3` | rest time |"));
  EXPECT_TRUE(test::contains(page, "too soft"));
}

}  // namespace
}  // namespace palpate::torture
