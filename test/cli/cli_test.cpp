// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "palpate/analysis/case.h"
#include "palpate/scene/scene.h"
#include "run_cli.h"

namespace palpate::cli_test {
namespace {

using test::CliResult;
using test::runCli;

TEST(Cli, DocsPrintsTheGeneratedPages) {
  const CliResult scene = runCli("docs scene_format");
  EXPECT_EQ(scene.status, 0);
  EXPECT_EQ(scene.out, scene::sceneFormatMarkdown());
  const CliResult solve = runCli("docs case_format");
  EXPECT_EQ(solve.status, 0);
  EXPECT_EQ(solve.out, analysis::caseFormatMarkdown());
}

TEST(Cli, HelpAndVersion) {
  const CliResult help = runCli("--help");
  EXPECT_EQ(help.status, 0);
  EXPECT_NE(help.out.find("Exit status"), std::string::npos);
  const CliResult version = runCli("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out.rfind("palpate ", 0), 0u);
}

TEST(Cli, WrongArgumentsAreBadInput) {
  for (const char* arguments : {"", "nonsense", "docs", "docs nonsense", "docs scene_format x"}) {
    const CliResult result = runCli(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_NE(result.err, "") << arguments;
  }
}

}  // namespace
}  // namespace palpate::cli_test
