// SPDX-License-Identifier: GPL-3.0-or-later
// Shipped scenes by their names, from the sources and as installed.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "run_cli.h"
#include "support/contains.h"
#include "support/source_folder.h"

namespace palpate::scenes_command_test {
namespace {

namespace fs = std::filesystem;
using test::contains;
using test::runCli;

const std::string kConfig = test::sourceFolder() + "/config";

TEST(ScenesCommand, ListsThemAllWithTheirTrajectories) {
  const test::CliResult listed = runCli("scenes");
  ASSERT_EQ(listed.status, 0) << listed.err;
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(kConfig + "/scenes")) {
    EXPECT_TRUE(contains(listed.out, "\n" + entry.path().stem().string() + " "));
    ++scenes;
  }
  EXPECT_EQ(std::count(listed.out.begin(), listed.out.end(), '\n'), scenes + 1);
  EXPECT_TRUE(contains(listed.out, "slab_sampled                 0.1  slab_probe\n"));
}

TEST(ScenesCommand, SaysWhereOneIs) {
  const test::CliResult said = runCli("scenes slab_bem");
  EXPECT_EQ(said.out, "scene " + kConfig + "/scenes/slab_bem.yaml\ntrajectory " + kConfig +
                          "/trajectories/slab_probe.csv\n");
}

TEST(ScenesCommand, EveryCommandThatTakesAScenesNameRefusesOneThatIsNone) {
  const test::TempFolder folder;
  const std::string out = " --out '" + folder.path("out");
  const std::string commands[] = {
      "scenes slab_prob", "replay slab_prob --trajectory x.csv" + out + ".csv'",
      "hand slab_prob" + out + ".csv'", "database slab_prob --force 1" + out + "'",
      "mesh --scene slab_prob" + out + ".vtu'"};
  for (const std::string& command : commands) {
    const test::CliResult refused = runCli(command);
    EXPECT_EQ(refused.status, 2) << command;
    EXPECT_TRUE(contains(refused.err, "slab_prob: is no file and no shipped scene")) << command;
    EXPECT_TRUE(contains(refused.err, "did you mean slab_probe?"));
    EXPECT_TRUE(contains(refused.err, "liver_palpation"));
  }
}

TEST(ScenesCommand, ANameIsEnoughForAReplay) {
  const test::TempFolder folder;
  const test::CliResult by_name =
      runCli("replay slab_tensor_mass --out '" + folder.path("a.csv") + "'");
  EXPECT_EQ(by_name.status, 0) << by_name.err;
  EXPECT_TRUE(
      contains(by_name.err, "note: the trajectory is " + kConfig + "/trajectories/slab_probe.csv"));
  const test::CliResult by_file =
      runCli("replay '" + kConfig + "/scenes/slab_tensor_mass.yaml' --trajectory '" + kConfig +
             "/trajectories/slab_probe.csv' --out '" + folder.path("b.csv") + "'");
  EXPECT_EQ(by_file.status, 0) << by_file.err;
  EXPECT_EQ(by_name.out.substr(0, by_name.out.find('\n')),
            by_file.out.substr(0, by_file.out.find('\n')));

  folder.write("own.yaml", "");
  const test::CliResult own = runCli("replay '" + folder.path("own.yaml") + "' --out x.csv");
  EXPECT_EQ(own.status, 2);
}

// The program next to the shipped files, without a setting of their place.
TEST(ScenesCommand, AnInstalledProgramFindsWhatIsInstalled) {
  for (const char* program : {"bin/palpate", "lib/palpate/palpate"}) {
    const test::TempFolder folder;
    const std::string scene = folder.write("share/palpate/config/scenes/only.yaml",
                                           test::fileBytes(kConfig + "/scenes/slab_probe.yaml"));
    fs::create_directories(fs::path(folder.path(program)).parent_path());
    fs::copy_file(PALPATE_CLI, folder.path(program));
    const test::CliResult said = test::runProgram(folder.path(program), "scenes only");
    EXPECT_EQ(said.out, "scene " + scene + "\ntrajectory \n") << said.err;
    const test::CliResult told = test::runProgram(folder.path(program), "scenes slab_probe",
                                                  "PALPATE_SHARE='" + test::sourceFolder() + "'");
    EXPECT_TRUE(contains(told.out, "scene " + kConfig + "/scenes/slab_probe.yaml")) << told.err;
  }
}

}  // namespace
}  // namespace palpate::scenes_command_test
