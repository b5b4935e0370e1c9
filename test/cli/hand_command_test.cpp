// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "run_cli.h"
#include "sim/slab_scene.h"
#include "support/contains.h"

namespace palpate::cli::hand_command_test {
namespace {

using test::contains;
using test::runCli;

class HandCommand : public ::testing::Test {
 protected:
  test::CliResult hand(const std::string& arguments) const {
    return runCli("hand " + slab.file("gravity: [0, 0, 0]\n") + " " + arguments);
  }
  test::SlabScene slab;
};

TEST_F(HandCommand, RestsOnASlabAndSaysSo) {
  const test::CliResult result =
      hand("--depth 0.004 --duration 2 --out " + slab.folder().path("hand.csv"));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "swing of the last 1 s: ")) << result.out;
  EXPECT_TRUE(contains(result.out, "energy out of the port"));
  const std::string csv = test::fileBytes(slab.folder().path("hand.csv"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 2001);
}

// Where it means to, exactly, and stiffer tissue than the device can render is said.
TEST_F(HandCommand, PrescribesMotionsAndSaysHowStiffItRenders) {
  const test::CliResult result = hand(
      "--motion slide --prescribed --depth 0.004 --duration 2 --delay-in 0.01 --delay-out 0.01");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "deepest 4")) << result.out;
  EXPECT_TRUE(contains(result.out, "as rendered 1")) << result.out;  // 14 to 18 N/m
}

TEST_F(HandCommand, RefusesNumbersThatAreNoneByName) {
  for (const std::string option :
       {"--mass", "--rate", "--speed", "--duration", "--damping", "--grip-stiffness",
        "--grip-damping", "--resolution", "--depth", "--push", "--solve", "--delay-in",
        "--delay-out", "--passivity", "--device-rate"}) {
    const test::CliResult result = hand(option + " -1");
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_TRUE(contains(result.err, option + " = -1")) << result.err;
  }
  EXPECT_EQ(hand("--grip iron").status, 2);
  EXPECT_EQ(hand("--motion jump").status, 2);
  EXPECT_EQ(runCli("hand nowhere.yaml").status, 2);
}

}  // namespace
}  // namespace palpate::cli::hand_command_test
