// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "palpate/formats/surface_io.h"
#include "palpate/formats/vtu_writer.h"
#include "palpate/mesh/planar_mesh.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/springs/springs_file.h"
#include "run_cli.h"
#include "support/contains.h"

namespace palpate::springs_command_test {
namespace {

using test::CliResult;
using test::contains;
using test::runCli;

class SpringsCommand : public ::testing::Test {
 protected:
  SpringsCommand() {
    mesh::Polygon outline(2, 4);
    outline << 0, 32, 32, 0, 0, 0, 24, 24;  // centimetres
    formats::writeSurface(path("plate.obj"),
                          mesh::meshPolygon(outline, {mesh::circle({16, 12}, 6, 3)}, 3));
    formats::writeVtu(path("block.vtu"), mesh::boxMesh(Vec3(0.1, 0.1, 0.2), {2, 2, 4}), {}, {});
  }

  std::string path(const std::string& name) const { return folder_.path(name); }
  std::string springs(const std::string& arguments, const std::string& out = "s.csv") const {
    return "springs " + arguments + " --out '" + path(out) + "'";
  }
  std::string plate() const {
    return "'" + path("plate.obj") +
           "' --scale 0.01 --young-modulus 1e11 --poisson-ratio 0.3 --thickness 1e-3 "
           "--density 900";
  }
  std::string block() const {
    return "'" + path("block.vtu") + "' --young-modulus 5e3 --density 1000";
  }

  const test::TempFolder folder_;
};

TEST_F(SpringsCommand, FitsASheet) {
  const CliResult result = runCli(springs(plate()));
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* part :
       {"points", "structural", "flexion", "N_t", "3 N_t - 3 N_3 - 2 N_4 = ", "preload lacks",
        "balance", "no_tension", "bending", "stiffness lacks", "stretch_4", "explicit step",
        "out of balance   0 N", "free motions     6 without energy, 0 that lose energy"}) {
    EXPECT_TRUE(contains(result.out, part)) << part << "\n" << result.out;
  }
  const springs::SpringNetwork network = springs::readSprings(path("s.csv"));
  const double area = 0.32 * 0.24 - 0.5 * 13 * 0.0036 * std::sin(2 * 3.14159265358979 / 13);
  EXPECT_NEAR(network.masses.sum(), 900 * 1e-3 * area, 1e-9);
  const std::string bytes = test::fileBytes(path("s.csv"));
  EXPECT_EQ(runCli(springs(plate(), "t.csv")).status, 0);
  EXPECT_EQ(test::fileBytes(path("t.csv")), bytes);
}

TEST_F(SpringsCommand, FitsTetrahedraWithinTheBoundOfAStep) {
  const CliResult free = runCli(springs(block()));
  ASSERT_EQ(free.status, 0) << free.err;
  for (const char* part : {"edge", "isotropy", "direction", "0 as stiff as the step allows"}) {
    EXPECT_TRUE(contains(free.out, part)) << part << "\n" << free.out;
  }
  EXPECT_NEAR(springs::readSprings(path("s.csv")).masses.sum(), 2.0, 1e-12);
  const CliResult bounded = runCli(springs(block() + " --step 0.02"));
  ASSERT_EQ(bounded.status, 0) << bounded.err;
  EXPECT_FALSE(contains(bounded.out, " 0 as stiff as")) << bounded.out;
  EXPECT_TRUE(contains(bounded.out, "stable up to 20 ms")) << bounded.out;
  ASSERT_EQ(runCli(springs(block() + " --match-mean")).status, 0);
  double sum = 0.0;
  for (const springs::Spring& s : springs::readSprings(path("s.csv")).springs) {
    sum += 2 * s.stiffness * s.length * s.length;
  }
  EXPECT_NEAR(sum, 12 * 5e3 * 2e-3, 1e-9 * sum);  // 12 E V
}

TEST_F(SpringsCommand, MakesRegularMeshes) {
  const std::string E = " --young-modulus 1e6 --density 1000", sheet = " --thickness 1e-3";
  const auto out = [&](const std::string& arguments) {
    const CliResult result = runCli(springs("--regular " + arguments + E));
    EXPECT_EQ(result.status, 0) << arguments << "\n" << result.err;
    return result.out;
  };
  EXPECT_TRUE(contains(out("cubes --cells 2,2,2 --spacing 0.01"), "6 without energy"));
  EXPECT_TRUE(
      contains(out("cubes --cells 2,2,2 --spacing 0.01 --diagonals body"), "9 without energy"));
  EXPECT_TRUE(contains(out("line --cells 29 --spacing 0.01 --width 1e-3" + sheet), "28 flexion"));
  EXPECT_TRUE(
      contains(out("triangles --cells 5,5 --spacing 0.01 --poisson-ratio 0.3" + sheet), "36, "));
  const std::string squares = "squares --cells 4,3 --spacing 0.01 --poisson-ratio 0.3" + sheet;
  EXPECT_TRUE(contains(out(squares), "24 shear"));
  const double k1 = springs::readSprings(path("s.csv")).springs[0].stiffness;
  out(squares + " --printed");
  EXPECT_DOUBLE_EQ(2 * springs::readSprings(path("s.csv")).springs[0].stiffness, k1);
}

TEST_F(SpringsCommand, BadInput) {
  folder_.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  const std::string E = " --young-modulus 1e6 --density 1000";
  const auto refusal = [&](const std::string& arguments) {
    const CliResult result = runCli(springs(arguments, "bad.csv"));
    EXPECT_EQ(result.status, 2) << arguments << "\n" << result.out << result.err;
    EXPECT_FALSE(std::filesystem::exists(path("bad.csv"))) << arguments;
    return result.err;
  };
  const std::string cubes = "--regular cubes --cells 2,2,2 --spacing 0.01";
  EXPECT_TRUE(contains(refusal(E), "must be a file, or --regular"));
  EXPECT_TRUE(contains(refusal(cubes + " '" + path("block.vtu") + "'" + E), "and not both"));
  EXPECT_TRUE(
      contains(refusal("'" + path("plate.obj") + "'" + E), "--poisson-ratio: must be given"));
  EXPECT_TRUE(contains(refusal("'" + path("plate.obj") + "' --poisson-ratio 0.3" + E),
                       "--thickness: must be given for a sheet"));
  EXPECT_TRUE(contains(refusal("'" + path("plate.obj") + "' --thickness 1 --poisson-ratio 0.5" + E),
                       "--poisson-ratio = 0.5: must be in (-1, 0.5)"));
  EXPECT_TRUE(contains(refusal("'" + path("flat.obj") + "' --thickness 1 --poisson-ratio 0.3" + E),
                       "triangle 0: is collapsed"));
  EXPECT_TRUE(contains(refusal(block() + " --poisson-ratio 0.3"), "whose springs have 1/4"));
  EXPECT_TRUE(contains(refusal(block() + " --step 0"), "--step = 0: must be a number > 0"));
  EXPECT_TRUE(contains(refusal(block() + " --cells 3"), "--cells: has no meaning for a file"));
  EXPECT_TRUE(contains(refusal("--regular cubes --cells 2,2 --spacing 1" + E),
                       "--cells = 2,2: must be 3 whole numbers"));
  EXPECT_TRUE(contains(refusal("--regular cubes --cells 2,2,0 --spacing 1" + E), "whole numbers"));
  EXPECT_TRUE(contains(refusal("--regular cubes --cells 2,2,x --spacing 1" + E), "whole numbers"));
  EXPECT_TRUE(contains(refusal("--regular cubes --cells 999,999,999 --spacing 1" + E), "or less"));
  EXPECT_TRUE(contains(refusal("--regular cubes --cells 2,2,2" + E), "--spacing: must be given"));
  EXPECT_TRUE(contains(refusal(cubes + " --match-mean" + E), "which has nothing to choose"));
  EXPECT_TRUE(contains(refusal(cubes + " --width 1" + E), "--width: has no meaning"));
  EXPECT_TRUE(contains(refusal(cubes + " --young-modulus nan --density 1"), "--young-modulus"));
  for (const std::string& arguments :
       {cubes, "--regular spheres --cells 1 --spacing 1" + E, cubes + " --diagonals all" + E,
        "'" + path("absent.obj") + "' --thickness 1 --poisson-ratio 0.3" + E,
        "'" + path("absent.vtu") + "'" + E}) {
    EXPECT_NE(refusal(arguments), "") << arguments;
  }
  EXPECT_EQ(runCli("springs " + cubes + E + " --out '" + path("a.txt") + "'").status, 2);
  EXPECT_EQ(runCli("springs --help").status, 0);
}

}  // namespace
}  // namespace palpate::springs_command_test
