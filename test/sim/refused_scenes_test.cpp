// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that can be read, and ask of their organ or instrument what it is not.
#include <gtest/gtest.h>

#include "palpate/base/error.h"
#include "palpate/sim/simulator.h"
#include "support/contains.h"
#include "support/input_error.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::sim::refused_scenes_test {
namespace {

using test::contains;

class RefusedScenes : public ::testing::Test {
 protected:
  scene::Scene sceneWith(const std::vector<std::pair<std::string, std::string>>& changes) const {
    const std::string config = test::sourceFolder() + "/config/";
    std::string text = R"(
organs:
  - name: slab
    surface: )" + config +
                       R"(organs/slab.obj
    model: bem
    edge_length: 0.04
    material: {young_modulus: 5.0e3, poisson_ratio: 0.48, density: 1000}
    supports: [{select: {plane: {axis: z, at: 0, tolerance: 1.0e-4}}}]
instruments:
  - name: probe
    urdf: )" + config + R"(instruments/probe.urdf
    control_frame: tip
)";
    for (const auto& [from, to] : changes) {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      text.replace(at, from.size(), to);
    }
    return scene::readScene(folder_.write("scene.yaml", text));
  }
  std::string complaintWith(const std::string& from, const std::string& to) const {
    const scene::Scene scene = sceneWith({{from, to}});
    return test::complaint([&] { Simulator simulator(scene); });
  }

  test::TempFolder folder_;
};

TEST_F(RefusedScenes, TheGoodOneIsMade) { EXPECT_EQ(complaintWith("slab\n", "slab\n"), ""); }

TEST_F(RefusedScenes, AnInstrumentHasItsLinks) {
  EXPECT_TRUE(contains(complaintWith("control_frame: tip", "control_frame: tp"),
                       "instruments[0].control_frame = tp: must be a link of"));
  EXPECT_TRUE(contains(complaintWith("control_frame: tip", "control_frame: tp"), "mean tip?"));
}

TEST_F(RefusedScenes, BoundaryElementsAreGluedAndAtRest) {
  EXPECT_TRUE(contains(complaintWith("1.0e-4}}}", "1.0e-4}}, kind: slide}"),
                       "supports[0].kind = slide: model bem knows organs that are"));
  EXPECT_TRUE(contains(complaintWith("1.0e-4}}}", "1.0e-4}}, motion: {amplitude: [0, 0, 0.01]}}"),
                       "supports[0].motion: model bem knows organs that are"));
  EXPECT_TRUE(
      contains(complaintWith("supports:", "pressure: [{cavity: 0, pressure: 100}]\n    supports:"),
               "pressure: model bem knows none"));
}

// Of a slab 100 x 100 x 30 mm: they were made for minutes.
TEST_F(RefusedScenes, TooManyTrianglesAreNotMade) {
  EXPECT_TRUE(
      contains(complaintWith("edge_length: 0.04", "edge_length: 1.0e-4"),
               "edge_length = 0.0001: would make about 7390083 triangles, more than 20000"));
}

// A kidney of 0.03 m had half its volume left, one of 0.1 m a twentieth, and nobody said so.
TEST_F(RefusedScenes, TrianglesResolveTheSurface) {
  const std::string from = "slab.obj\n    model: bem\n    edge_length: 0.04";
  const auto of = [](const std::string& length) {
    return "kidney.obj\n    model: bem\n    edge_length: " + length;
  };
  const std::string held = "at: 0, tolerance: 1.0e-4", end = "at: 0, tolerance: 0.005";
  for (const char* length : {"0.03", "0.1", "0.5"}) {
    EXPECT_TRUE(contains(complaintWith(from, of(length)),
                         "triangles as large do not resolve the surface; must be smaller"))
        << length;
  }
  const auto warningsOf = [&](const std::string& length) {
    Simulator simulator(sceneWith({{from, of(length)}, {held, end}}));
    return joinNames(simulator.warnings());
  };
  EXPECT_TRUE(contains(warningsOf("0.02"), "edge_length = 0.02: triangles as large enclose"));
  EXPECT_EQ(warningsOf("0.01"), "");
}

}  // namespace
}  // namespace palpate::sim::refused_scenes_test
