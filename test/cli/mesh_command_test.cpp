// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdlib>

#include "palpate/formats/tet_io.h"
#include "run_cli.h"
#include "support/contains.h"
#include "support/source_folder.h"

namespace palpate::mesh_command_test {
namespace {

using test::CliResult;
using test::contains;
using test::runCli;

class MeshCommand : public ::testing::Test {
 protected:
  MeshCommand() { setenv("XDG_CACHE_HOME", folder_.path("cache").c_str(), 1); }

  std::string path(const std::string& name) const { return folder_.path(name); }
  CliResult organ(const std::string& file) const {
    return runCli("organ slab --edge-length 0.02 --out '" + file + "'");
  }

  const test::TempFolder folder_;
};

TEST_F(MeshCommand, MakesAnOrganAndFillsIt) {
  const CliResult organ_result = organ(path("slab.obj"));
  ASSERT_EQ(organ_result.status, 0) << organ_result.err;
  EXPECT_TRUE(contains(organ_result.out, "triangles"));

  const std::string arguments =
      "mesh '" + path("slab.obj") + "' --edge-length 0.02 --out '" + path("slab.vtu") + "'";
  const CliResult first = runCli(arguments);
  ASSERT_EQ(first.status, 0) << first.err;
  for (const char* part : {"nothing to repair", "nodes", "tetrahedra", "dihedral angle   min",
                           "radius/edge      worst", "% from the surface's", "meshing took"}) {
    EXPECT_TRUE(contains(first.out, part));
  }
  EXPECT_EQ(first.out.find("from the cache"), std::string::npos);
  EXPECT_TRUE(contains(first.err, "exuding slivers ...\n"));  // a line a stage, no terminal
  EXPECT_EQ(first.err.find('\r'), std::string::npos);
  const std::string bytes = test::fileBytes(path("slab.vtu"));

  const mesh::TetMesh mesh = formats::readTetMesh(path("slab.vtu"));
  double volume = 0.0;
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    volume += mesh::signedVolume(mesh.points, mesh.tets.col(t));
  }
  EXPECT_NEAR(volume, 0.1 * 0.1 * 0.03, 1e-9);  // [m^3], a box is filled exactly

  const CliResult second = runCli(arguments);
  EXPECT_EQ(second.status, 0);
  EXPECT_TRUE(contains(second.out, "from the cache"));
  EXPECT_EQ(test::fileBytes(path("slab.vtu")), bytes);

  const CliResult anew = runCli(arguments + " --no-cache");
  EXPECT_EQ(anew.status, 0);
  EXPECT_EQ(anew.out.find("from the cache"), std::string::npos);
  EXPECT_EQ(test::fileBytes(path("slab.vtu")), bytes);
}

TEST_F(MeshCommand, ScaleIsAppliedOrSuggested) {
  ASSERT_EQ(organ(path("slab.obj")).status, 0);
  const std::string arguments =
      "mesh '" + path("slab.obj") + "' --edge-length 0.002 --out '" + path("slab.vtu") + "'";
  const CliResult kilometres = runCli(arguments + " --scale 1000");
  EXPECT_EQ(kilometres.status, 2);
  EXPECT_TRUE(contains(kilometres.err, "--scale"));
  const CliResult small = runCli(arguments + " --scale 0.1");
  ASSERT_EQ(small.status, 0) << small.err;
  EXPECT_NEAR(formats::readTetMesh(path("slab.vtu")).points.row(0).maxCoeff(), 0.005, 1e-9);
}

TEST_F(MeshCommand, GradesAndShowsHowLongEdgesAre) {
  ASSERT_EQ(organ(path("slab.obj")).status, 0);
  const std::string coarse = "mesh '" + path("slab.obj") + "' --edge-length 0.015 --out '";
  const CliResult graded = runCli(coarse + path("graded.vtu") +
                                  "' --near 0,0,0.03 --near=-0.03,0,0.03 --finest 0.004 "
                                  "--radius 0.005 --growth 0.4");
  ASSERT_EQ(graded.status, 0) << graded.err;
  EXPECT_TRUE(contains(graded.out, " mm, least ")) << graded.out;
  EXPECT_TRUE(contains(graded.out, "    3 to 5 mm  ")) << graded.out;
  EXPECT_TRUE(contains(graded.out, "    10 to 15 mm ")) << graded.out;
  ASSERT_EQ(runCli(coarse + path("even.vtu") + "'").status, 0);
  EXPECT_GT(formats::readTetMesh(path("graded.vtu")).numTets(),
            3 * formats::readTetMesh(path("even.vtu")).numTets() / 2);
}

TEST_F(MeshCommand, MeshesAnOrganAsItsSceneSays) {
  ASSERT_EQ(organ(path("slab.obj")).status, 0);
  const std::string one = R"(organs:
  - name: slab
    surface: slab.obj
    edge_length: {coarsest: 0.015, near: [{finest: 0.004, point: [0, 0, 0.03], radius: 0.005}]}
    material: {young_modulus: 6.0e3, poisson_ratio: 0.45, density: 1000.0}
)";
  folder_.write("one.yaml", one);
  const std::string block =
      "  - {name: block, tetrahedra: graded.vtu, material: {young_modulus: 6.0e3, "
      "poisson_ratio: 0.45, density: 1000.0}}\n";
  folder_.write("two.yaml", one + block);
  ASSERT_EQ(runCli("mesh '" + path("slab.obj") +
                   "' --edge-length 0.015 --near 0,0,0.03 --finest "
                   "0.004 --radius 0.005 --out '" +
                   path("graded.vtu") + "'")
                .status,
            0);
  const std::string out = "' --out '" + path("scene.vtu") + "'";
  for (const char* scene : {"one.yaml'", "two.yaml' --organ slab"}) {
    const CliResult result =
        runCli("mesh --scene '" + path("") + scene + " --out '" + path("scene.vtu") + "'");
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(contains(result.out, "from the cache")) << result.out;
    EXPECT_EQ(test::fileBytes(path("scene.vtu")), test::fileBytes(path("graded.vtu")));
    std::filesystem::remove(path("scene.vtu"));
  }
  const auto refusal = [&](const std::string& arguments) {
    const CliResult result = runCli("mesh --scene '" + path(arguments));
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_FALSE(std::filesystem::exists(path("scene.vtu"))) << arguments;
    return result.err;
  };
  EXPECT_TRUE(contains(refusal("two.yaml" + out), "--organ: must be one of slab, block"));
  EXPECT_TRUE(contains(refusal("one.yaml" + out + " --organ spleen"), "must be one of slab"));
  EXPECT_TRUE(contains(refusal("two.yaml" + out + " --organ block"), "must have a surface"));
  EXPECT_TRUE(contains(refusal("one.yaml" + out + " --edge-length 0.01"), "has the sizes"));
}

// The probe's ball goes along y = 0.01 at the height of the slab's top, in the slab's own frame;
// the points between the corners do not matter.
TEST_F(MeshCommand, GradesAlongTheWayOfATool) {
  ASSERT_EQ(organ(path("slab.obj")).status, 0);
  folder_.write("T.csv",
                "t,x,y,z,roll,pitch,yaw\n0,-0.02,0.01,-0.07,0,0,0\n1,0,0.01,-0.07,0,0,0\n"
                "2,0.01,0.01,-0.07,0,0.5,0\n3,0.02,0.01,-0.07,0,0,1\n");
  const auto scene = [&](const std::string& place) {
    return R"(organs:
  - name: slab
    surface: slab.obj
    pose: {position: [0.3, 0, 0]}
    material: {young_modulus: 6.0e3, poisson_ratio: 0.45, density: 1000.0}
    edge_length: {coarsest: 0.015, near: [{finest: 0.004, )" +
           place + R"(}]}
instruments:
  - name: probe
    base: {position: [0.3, 0, 0.1]}
    control_frame: tip
    urdf: )" +
           test::sourceFolder() + "/config/instruments/probe.urdf\n";
  };
  const auto mesh = [&](const std::string& place) {
    folder_.write("scene.yaml", scene(place));
    return runCli("mesh --scene '" + path("scene.yaml") + "' --out '" + path("a.vtu") + "'");
  };
  const CliResult way = mesh("trajectory: T.csv");
  ASSERT_EQ(way.status, 0) << way.err;
  const mesh::TetMesh along = formats::readTetMesh(path("a.vtu"));
  ASSERT_EQ(mesh("path: [[-0.02, 0.01, 0.03], [0.02, 0.01, 0.03]]").status, 0);
  EXPECT_NEAR(static_cast<double>(along.numTets()),
              static_cast<double>(formats::readTetMesh(path("a.vtu")).numTets()),
              0.03 * static_cast<double>(along.numTets()));
  EXPECT_TRUE(contains(mesh("trajectory: T.csv, instrument: grasper").err,
                       "near[0].instrument = grasper: must be one of probe"));
  EXPECT_TRUE(contains(mesh("trajectory: absent.csv").err, "no such file"));
  folder_.write("T.csv", "t,x,y,z\n0,0,0,0\n");
  EXPECT_TRUE(contains(mesh("trajectory: T.csv, instrument: probe").err, "T.csv: "));
}

TEST_F(MeshCommand, BadInput) {
  ASSERT_EQ(organ(path("slab.obj")).status, 0);
  const std::string out = " --out '" + path("a.vtu") + "'";
  const std::string slab = "mesh '" + path("slab.obj") + "'";
  for (const std::string& arguments :
       {slab + out,
        slab + " --edge-length 0.01",
        slab + " --edge-length nan" + out,
        slab + " --edge-length -1" + out,
        slab + " --edge-length x" + out,
        slab + " --edge-length 0.01 --scale 0" + out,
        slab + " --edge-length 0.02 --near 0,0,0.03" + out,
        slab + " --edge-length 0.02 --finest 0.01" + out,
        slab + " --edge-length 0.02 --near 0,0 --finest 0.01" + out,
        slab + " --edge-length 0.02 --near 0,0,x --finest 0.01" + out,
        slab + " --edge-length 0.02 --near 0,0,0.03,1 --finest 0.01" + out,
        slab + " --edge-length 0.02 --near 0,0,0.03 --finest 0" + out,
        slab + " --edge-length 0.02 --near 0,0,9 --finest 0.01" + out,
        slab + " --edge-length 0.02 --near 0,0,0.03 --finest 0.01 --growth 2" + out,
        slab + " --edge-length 0.02 --organ slab" + out,
        "mesh" + out,
        "mesh '" + path("absent.obj") + "' --edge-length 0.01" + out,
        slab + " --edge-length 0.02 --out '" + path("no/such/a.vtu") + "'",
        slab + " --edge-length 0.02 --out '" + path("a.xyz") + "'",
        "organ slab --edge-length 0.02 --out '" + path("no/such/a.obj") + "'",
        "organ spleen --edge-length 0.02 --out '" + path("a.obj") + "'",
        "organ slab --edge-length 0 --out '" + path("a.obj") + "'",
        "organ slab --edge-length 0.02 --out '" + path("a.xyz") + "'"}) {
    const CliResult result = runCli(arguments);
    EXPECT_EQ(result.status, 2) << arguments << "\n" << result.err;
    EXPECT_NE(result.err, "") << arguments;
    EXPECT_FALSE(std::filesystem::exists(path("a.vtu"))) << arguments;
  }
}

}  // namespace
}  // namespace palpate::mesh_command_test
