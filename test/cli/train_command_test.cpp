// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "palpate/enrichment/surrogate_file.h"
#include "run_cli.h"
#include "support/contains.h"
#include "support/source_folder.h"

namespace palpate::train_command_test {
namespace {

using test::contains;
using test::runCli;

TEST(TrainCommand, LearnsFromADatabaseAndRefusesWhatIsWrongByName) {
  const test::TempFolder folder;
  const std::string data = folder.path("db"), out = folder.path("a.net");
  const auto train = [&](const std::string& more) {
    return runCli("train '" + data + "' --out '" + out + "' " + more);
  };
  ASSERT_EQ(
      runCli("database '" + test::sourceFolder() + "/config/scenes/slab_probe.yaml' --out '" +
             data + "' --triangles 100 --splits 1 --edge-length 0.02 --force 0.3 --samples 16")
          .status,
      0);
  for (const char* kind : {"kernel", "network"}) {
    const auto result = train(std::string("--hidden 8 --modes 4 --iterations 50 --check '") + data +
                              "' --kind " + kind);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(contains(result.out, "learned   ")) << result.out;
    EXPECT_TRUE(contains(result.out, "held out  ")) << result.out;
    EXPECT_TRUE(contains(result.out, "checked   16 samples")) << result.out;
    const enrichment::Surrogate made = enrichment::readSurrogate(out);
    EXPECT_EQ(made.numModes(), 4);
    EXPECT_EQ(made.surface.triangles.cols(), 400);
    EXPECT_GT(made.patch, 0.0);
  }
  for (const auto& [more, part] : {std::pair{"--hidden 0", "--hidden"},
                                   {"--hidden 8,x", "--hidden"},
                                   {"--holdout 1", "holdout"},
                                   {"--holdout 0.9", "10 samples"},
                                   {"--kind forest", "--kind"}}) {
    const auto result = train(more);
    EXPECT_EQ(result.status, 2) << more;
    EXPECT_TRUE(contains(result.err, part)) << result.err;
  }
}

}  // namespace
}  // namespace palpate::train_command_test
