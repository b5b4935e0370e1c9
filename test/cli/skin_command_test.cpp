// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "palpate/formats/tet_io.h"
#include "palpate/mesh/tet_mesh.h"
#include "run_cli.h"
#include "support/contains.h"
#include "support/source_folder.h"

namespace palpate::skin_command_test {
namespace {

using test::CliResult;
using test::contains;
using test::runCli;

class SkinCommand : public ::testing::Test {
 protected:
  std::string skin(const std::string& arguments) const {
    return "skin --out '" + folder_.path("out") + "' " + arguments;
  }
  std::string table(const std::string& name) const {
    return test::fileBytes(folder_.path("out/" + name));
  }
  static long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

  const test::TempFolder folder_;
};

TEST_F(SkinCommand, SaysDepthErrorAndForceAndSweeps) {
  const CliResult result = runCli(skin("--weight 0.7"));
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* part : {"119 nodes, 192 triangles, band 16", "1.9581", "0.017825", "0.9097",
                           "0.019863", "least larger", "least sum", "least weighted", "of 45"}) {
    EXPECT_TRUE(contains(result.out, part)) << part;
  }
  EXPECT_FALSE(contains(result.out, "warning"));
  const std::string sweep = table("sweep.csv");
  EXPECT_EQ(lines(sweep), 1 + 2 * 5 * 9);
  EXPECT_EQ(lines(table("profiles.csv")), 1 + 18 + 12);
  EXPECT_EQ(lines(table("nodes.csv")), 1 + 119);
  EXPECT_EQ(lines(table("triangles.csv")), 1 + 192);
  ASSERT_EQ(runCli(skin("--weight 0.7")).status, 0);
  EXPECT_EQ(table("sweep.csv"), sweep);
}

TEST_F(SkinCommand, CountsThePrintedFiguresThatAgree) {
  const CliResult result = runCli(skin("--published"));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "576 of 576"));
  const std::string all = table("published.csv");
  EXPECT_EQ(lines(all), 577);
  EXPECT_TRUE(
      contains(all, "table,set,nx,nz,layer1_rows,el_f,printed,ours\n3.3,1,16,6,1,1,0.098849,"));
}

TEST_F(SkinCommand, TakesEachVariant) {
  for (const char* variant : {"plane_stress", "plane_strain", "axisymmetric"}) {
    const CliResult result =
        runCli(skin(std::string("--ratios 3,10 --diagonals alternating --mesh 32x12 --patch "
                                "0.000375 --fixed --variant ") +
                    variant));
    EXPECT_EQ(result.status, 0) << variant << result.err;
    EXPECT_EQ(lines(table("sweep.csv")), 1 + 2 * 11 * 2);
  }
}

TEST_F(SkinCommand, WritesTheBlockInSpace) {
  const CliResult result = runCli(skin("--ratios none --mesh 8x3 --fraction 0.333333 --block 4"));
  ASSERT_EQ(result.status, 0) << result.err;
  const mesh::TetMesh block = formats::readTetMesh(folder_.path("out/block.vtu"));
  EXPECT_EQ(block.numTets(), 4 * 4 * 3 * 6);
  EXPECT_EQ(block.points.rowwise().minCoeff(), Vec3(-0.006, -0.006, 0.0));
  EXPECT_LT((block.points.rowwise().maxCoeff() - Vec3(0.006, 0.006, 0.0045)).norm(), 1e-15);
  double upper = 0.0;
  for (Eigen::Index t = 0; t < block.numTets(); ++t) {
    const bool above = block.region[static_cast<std::size_t>(t)] == 1;
    for (const int node : block.tets.col(t)) {  // the interface is a plane of nodes
      EXPECT_TRUE(above ? block.points(2, node) > 0.0029 : block.points(2, node) < 0.0031);
    }
    if (above) upper += mesh::signedVolume(block.points, block.tets.col(t));
  }
  EXPECT_NEAR(upper, 0.012 * 0.012 * 0.0015, 1e-15);
}

TEST_F(SkinCommand, MakesTheShippedBlock) {
  ASSERT_EQ(runCli(skin("--ratios none --mesh 12x6 --block 12")).status, 0);
  EXPECT_EQ(table("block.vtu"),
            test::fileBytes(test::sourceFolder() + "/config/organs/skin_block.vtu"));
}

TEST_F(SkinCommand, WarnsOfInversionAndBone) {
  const CliResult shallow = runCli(skin("--ratios none --depth 0.0027"));
  ASSERT_EQ(shallow.status, 0) << shallow.err;
  EXPECT_FALSE(contains(shallow.out, "warning"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("out/sweep.csv")));
  const CliResult deep = runCli(skin("--ratios none --depth 0.0032"));
  EXPECT_TRUE(contains(deep.out, "inverted, from 2.79"));
  EXPECT_TRUE(contains(deep.out, "below the bone, from 3.16"));
}

TEST_F(SkinCommand, RefusesWhatCannotBe) {
  const auto refused = [&](const std::string& arguments, const std::string& part) {
    const CliResult result = runCli(skin(arguments));
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_TRUE(contains(result.err, part)) << arguments << result.err;
  };
  refused("--fraction 0.4", "puts the interface inside an element; must be a multiple of 1/6");
  refused("--mesh 16", "as 16x6");
  refused("--mesh 15x6", "must be even");
  refused("--mesh 16x2.5", "two whole numbers");
  refused("--ratio -1", "stiffness_ratio = -1: must be a number > 0");
  refused("--ratios 1,two", "--ratios = 1,two");
  refused("--patch 0.001", "must end at a node");
  refused("--depth nan", "finite");
  refused("--block 0", "--block = 0: must be >= 1");
  refused("--weight 2", "in [0, 1]");
  refused("--variant plane", "--variant");
  EXPECT_EQ(runCli("skin").status, 2);
}

}  // namespace
}  // namespace palpate::skin_command_test
