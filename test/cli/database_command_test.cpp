// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "palpate/enrichment/database_folder.h"
#include "run_cli.h"
#include "support/contains.h"
#include "support/source_folder.h"

namespace palpate::database_command_test {
namespace {

using test::CliResult;
using test::contains;
using test::runCli;

class DatabaseCommand : public ::testing::Test {
 protected:
  CliResult make(const std::string& arguments, const std::string& out = "db") const {
    return runCli("database '" + test::sourceFolder() + "/config/scenes/slab_probe.yaml" +
                  "' --out '" + path(out) +
                  "' --triangles 100 --splits 1 --edge-length 0.02 --force 0.3 " + arguments);
  }
  std::string path(const std::string& name) const { return folder_.path(name); }

  const test::TempFolder folder_;
};

TEST_F(DatabaseCommand, PressesAnOrganWhereNothingHoldsIt) {
  const CliResult result = make("--samples 5");
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "5 made now, 0 of them not solved")) << result.out;
  const enrichment::DeformationDatabase database = enrichment::readDatabase(path("db"));
  ASSERT_EQ(database.samples.size(), 5U);
  EXPECT_EQ(database.coarse.triangles.cols(), 100);
  EXPECT_EQ(database.fine.triangles.cols(), 400);
  for (const enrichment::Deformation& sample : database.samples) {
    const Vec3 moved = sample.fine.col(sample.contact);
    EXPECT_GT(moved.dot(sample.force), 0.0);
    EXPECT_GT(moved.norm(), 1e-5);
    EXPECT_GT(database.coarse.points(2, sample.contact), 1e-3);  // the bottom is held
  }
}

TEST_F(DatabaseCommand, GoesOnWithWhatIsThereAndMakesTheSameInParts) {
  ASSERT_EQ(make("--samples 4").status, 0);
  const CliResult more = make("--samples 6 --threads 2");
  EXPECT_TRUE(contains(more.out, "6 of this part, 2 made now")) << more.out;
  for (const char* part : {"1/2", "0/2"}) {
    ASSERT_EQ(make(std::string("--samples 6 --part ") + part, "parts").status, 0);
  }
  const auto one = enrichment::readDatabase(path("db")),
             other = enrichment::readDatabase(path("parts"));
  ASSERT_EQ(one.samples.size(), 6U);
  ASSERT_EQ(other.samples.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(one.samples[k].fine, other.samples[k].fine);
}

TEST_F(DatabaseCommand, PressesWithinABall) {
  ASSERT_EQ(make("--samples 12 --within 0,0,0.03,0.03").status, 0);
  const enrichment::DeformationDatabase database = enrichment::readDatabase(path("db"));
  ASSERT_EQ(database.samples.size(), 12U);
  for (const enrichment::Deformation& sample : database.samples) {
    EXPECT_LE((database.coarse.points.col(sample.contact) - Vec3(0, 0, 0.03)).norm(), 0.03);
  }
}

TEST_F(DatabaseCommand, RefusesWhatIsWrongByName) {
  ASSERT_EQ(make("--samples 1").status, 0);
  for (const auto& [arguments, part] :
       {std::pair<std::string, std::string>{"--seed 2", "has deformations of another body"},
        {"--part 2/2", "--part = 2/2: must be K/N"},
        {"--part 1", "--part = 1: must be K/N"},
        {"--patch -1", "--patch"},
        {"--cone 0", "--cone"},
        {"--within 0,0,0.03", "must be X,Y,Z,R"},
        {"--within 0,0,0.03,-1", "must be X,Y,Z,R"},
        {"--within 0,0,9,0.01", "must hold points"},
        {"--organ spleen", "--organ = spleen: must be one of slab"}}) {
    const CliResult result = make(arguments + " --samples 1");
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_TRUE(contains(result.err, part)) << result.err;
  }
}

TEST_F(DatabaseCommand, RefusesAnOrganThatNothingHolds) {
  const std::string scene = folder_.write(
      "free.yaml", "name: free\ngravity: [0, 0, 0]\norgans:\n  - {name: slab, surface: '" +
                       test::sourceFolder() +
                       "/config/organs/slab.obj', edge_length: 0.02, "
                       "material: {law: neo_hookean, young_modulus: 5.0e+3, poisson_ratio: 0.3, "
                       "density: 1000}}\n");
  const CliResult result = runCli("database '" + scene + "' --out '" + path("free") +
                                  "' --triangles 100 --splits 1 --edge-length 0.02 --force 0.3");
  EXPECT_EQ(result.status, 2);
  for (const std::string part : {scene.c_str(), "organs[0].supports", "must hold the organ"}) {
    EXPECT_TRUE(contains(result.err, part)) << result.err;
  }
}

}  // namespace
}  // namespace palpate::database_command_test
