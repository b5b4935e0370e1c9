// SPDX-License-Identifier: GPL-3.0-or-later
// Frames in tf of instruments whose links have the same names.
#include "ros/input/tool_frames.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "palpate/instrument/instrument.h"
#include "sim/slab_scene.h"
#include "support/contains.h"
#include "support/source_folder.h"

namespace palpate::node::tool_frames_test {
namespace {

/// A scene of instruments, each written as "name, urdf, more keys".
class ToolFrames : public ::testing::Test {
 protected:
  struct Tool {
    std::string name, urdf = "probe.urdf", more = "";
  };
  std::string file(const std::vector<Tool>& tools) const {
    std::string text =
        "name: s\norgans: [{name: o, surface: o.obj, material: {law: neo_hookean, "
        "young_modulus: 1.0e4, poisson_ratio: 0.4}}]\ninstruments:\n";
    for (const Tool& tool : tools) {
      const bool shipped = tool.urdf.find('/') == std::string::npos;
      text += "  - {name: " + tool.name + ", control_frame: tip, urdf: " +
              (shipped ? test::sourceFolder() + "/config/instruments/" : "") + tool.urdf +
              tool.more + "}\n";
    }
    return slab.folder().write("tools.yaml", text);
  }
  /// The prefixes after separateFrames().
  std::vector<std::string> separate(const std::vector<Tool>& tools) {
    scene::Scene scene = scene::readScene(file(tools));
    ambiguous = separateFrames(&scene);
    std::vector<std::string> prefixes;
    for (const scene::InstrumentConfig& i : scene.instruments) prefixes.push_back(i.tf_prefix);
    return prefixes;
  }
  using Names = std::vector<std::string>;

  test::SlabScene slab;
  Names ambiguous;
};

TEST_F(ToolFrames, StayWhereTheyAreUnique) {
  EXPECT_EQ(separate({{"probe"}}), Names{""});
  EXPECT_EQ(separate({{"probe", "probe.urdf", ", tf_prefix: p_"}, {"other"}}), (Names{"p_", ""}));
  EXPECT_TRUE(ambiguous.empty());
}

TEST_F(ToolFrames, OfTwoWithOneInCommonAreOfTheInstrument) {
  EXPECT_EQ(separate({{"left", "grasper.urdf"}, {"right", "grasper.urdf"}}),
            (Names{"left/", "right/"}));
  // Of different URDFs that share `tip`; a third instrument with names of its own.
  EXPECT_EQ(separate({{"a"}, {"b", "grasper.urdf"}, {"c", "probe.urdf", ", tf_prefix: c_"}}),
            (Names{"a/", "b/", "c_"}));
  EXPECT_EQ(
      separate({{"a", "probe.urdf", ", tf_prefix: p/"}, {"b", "probe.urdf", ", tf_prefix: p/"}}),
      (Names{"a/p/", "b/p/"}));
  EXPECT_TRUE(ambiguous.empty());
}

TEST_F(ToolFrames, BecomeUniqueWhateverPrefixesThereAre) {
  const Names prefixes = separate({{"a"},
                                   {"b"},
                                   {"c", "probe.urdf", ", tf_prefix: a/"},
                                   {"d", "probe.urdf", ", tf_prefix: b/"}});
  std::set<std::string> different(prefixes.begin(), prefixes.end());
  EXPECT_EQ(different.size(), 4u);
  EXPECT_TRUE(ambiguous.empty());
}

TEST_F(ToolFrames, ThatComeByTfAreNotRenamed) {
  EXPECT_EQ(separate({{"tracked", "probe.urdf", ", input: tf"}, {"driven"}}),
            (Names{"", "driven/"}));
  EXPECT_TRUE(ambiguous.empty());
  EXPECT_EQ(separate({{"a", "probe.urdf", ", input: tf"}, {"b", "probe.urdf", ", input: tf"}}),
            (Names{"", ""}));
  EXPECT_EQ(ambiguous, (Names{"a", "b"}));
}

// A root link called world is the world, unless the scene places it elsewhere.
TEST_F(ToolFrames, AreNotTheWorldsByChance) {
  const std::string urdf =
      slab.folder().write("world.urdf", R"(<robot name="r"><link name="world"/><link name="tip"/>
        <joint name="j" type="fixed"><parent link="world"/><child link="tip"/></joint></robot>)");
  EXPECT_EQ(separate({{"a", urdf}}), Names{""});
  EXPECT_EQ(separate({{"a", urdf, ", base: {position: [0, 0, 0.1]}"}}), Names{"a/"});
}

TEST_F(ToolFrames, OfAFileThatIsNotThereAreLoadingsBusiness) {
  EXPECT_EQ(separate({{"a", "/none.urdf"}, {"b"}}), (Names{"", ""}));
}

TEST_F(ToolFrames, AreTheLinksOfTheDescription) {
  scene::Scene scene = slab.scene();
  scene.instruments.push_back(scene.instruments[0]);
  scene.instruments[1].name = "second";
  ASSERT_TRUE(separateFrames(&scene).empty());
  const sim::Simulator simulator(scene);
  EXPECT_EQ(rootFrame(simulator, 1), "second/base");
  const std::string text = robotDescription(simulator, 1);
  const instrument::Instrument described =
      instrument::readInstrument(slab.folder().write("described.urdf", text));
  const instrument::Instrument& loaded = simulator.instrument(1);
  ASSERT_EQ(described.linkNames().size(), loaded.linkNames().size());
  for (std::size_t i = 0; i < loaded.linkNames().size(); ++i) {
    EXPECT_EQ(described.linkNames()[i], "second/" + loaded.linkNames()[i]);
  }
  EXPECT_EQ(described.jointNames(), loaded.jointNames());
}

// A tracker need not send the frames of links without shapes: rviz would show them as errors.
TEST_F(ToolFrames, OfATrackedToolAreThoseThatAreLookedUp) {
  scene::Scene scene = slab.scene();
  scene.instruments[0].input = "tf";
  scene.instruments[0].tf_prefix = "tracked/";
  const std::string text = robotDescription(sim::Simulator(scene), 0);
  EXPECT_TRUE(test::contains(text, "<link name=\"tracked/tip\">"));
  EXPECT_TRUE(test::contains(text, "<link name=\"tracked/shaft\">"));
  EXPECT_FALSE(test::contains(text, "tracked/base"));
  EXPECT_FALSE(test::contains(text, "slide"));
}

}  // namespace
}  // namespace palpate::node::tool_frames_test
