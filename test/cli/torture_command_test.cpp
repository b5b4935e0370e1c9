// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "palpate/torture/result_table.h"
#include "run_cli.h"
#include "support/contains.h"
#include "support/temp_folder.h"

namespace palpate::torture_command_test {
namespace {

using test::CliResult;
using test::runCli;

class TortureCommand : public ::testing::Test {
 protected:
  // A scene of 48 tetrahedra, drawn with implicit_pcg.
  CliResult run(const std::string& more) const {
    return runCli("torture --only 9849 --shrink 0 --out '" + folder_.path("") + "' " + more);
  }
  std::string methodOfTheLastLine() const {
    return torture::readResults(folder_.path("")).back().cell("method");
  }
  const test::TempFolder folder_;
};

TEST_F(TortureCommand, SolvesByTheMethodThatWasDrawnOrByAnotherOne) {
  CliResult result = run("");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(methodOfTheLastLine(), "implicit_pcg");
  result = run("--method lbfgs");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(methodOfTheLastLine(), "lbfgs");
}

TEST_F(TortureCommand, RefusesAMethodThatThereIsNot) {
  const CliResult result = run("--method newton");
  EXPECT_EQ(result.status, 2);
  for (const char* part : {"--method", "newton", "implicit_pcg"}) {
    EXPECT_TRUE(test::contains(result.err, part)) << result.err;
  }
}

}  // namespace
}  // namespace palpate::torture_command_test
