// SPDX-License-Identifier: GPL-3.0-or-later
// What other programs are told about an instrument.
#include "palpate/instrument/description.h"

#include <gtest/gtest.h>

#include "palpate/base/error.h"
#include "palpate/instrument/instrument.h"
#include "support/contains.h"
#include "support/temp_folder.h"
#include "urdf_text.h"

namespace palpate::instrument::description_test {
namespace {

const std::string kArm =
    robot(link("base") + link("arm") + link("tip") +
          joint("turn", "revolute", "base", "arm", limit()) + joint("end", "fixed", "arm", "tip"));

TEST(Description, NamesTheLinksInTheFilesOrder) {
  const test::TempFolder folder;
  EXPECT_EQ(readLinkNames(folder.write("arm.urdf", kArm)),
            (std::vector<std::string>{"base", "arm", "tip"}));
  EXPECT_THROW(readLinkNames(folder.path("none.urdf")), InputError);
  EXPECT_THROW(readLinkNames(folder.write("bad.urdf", robot(link("a") + link("b")))), InputError);
}

// Joints keep their names, as messages have them.
TEST(Description, PutsAPrefixBeforeLinksOnly) {
  const test::TempFolder folder;
  DescriptionSettings settings;
  settings.link_prefix = "left/";
  const std::string text = describeUrdf(folder.write("arm.urdf", kArm), settings);
  const Instrument arm = readInstrument(folder.write("left.urdf", text));
  EXPECT_EQ(arm.linkNames(), (std::vector<std::string>{"left/base", "left/arm", "left/tip"}));
  EXPECT_EQ(arm.jointNames(), std::vector<std::string>{"turn"});
}

TEST(Description, LeavesOutWhatIsNotAskedFor) {
  const test::TempFolder folder;
  DescriptionSettings settings;
  settings.link_prefix = "t_";
  settings.links = {"tip", "base"};
  const std::string text = describeUrdf(folder.write("arm.urdf", kArm), settings);
  EXPECT_TRUE(test::contains(text, "<link name=\"t_tip\"/>")) << text;
  EXPECT_TRUE(test::contains(text, "<parent link=\"t_tip\"/>")) << text;
  EXPECT_TRUE(test::contains(text, "<child link=\"t_base\"/>")) << text;
  EXPECT_FALSE(test::contains(text, "arm")) << text;
  EXPECT_FALSE(test::contains(text, "turn")) << text;
}

TEST(Description, SaysWhereMeshesAreWhoeverReadsIt) {
  const test::TempFolder folder;
  const auto visual = [](const std::string& file) {
    return "<visual><geometry><mesh filename=\"" + file + "\"/></geometry></visual>";
  };
  const std::string file = folder.write(
      "tools/arm.urdf", robot(link("a", visual("../meshes/a.stl") + visual("package://p/b.stl") +
                                            visual("/c.stl") + visual("file:///d.stl"))));
  const std::string text = describeUrdf(file, {});
  EXPECT_TRUE(test::contains(text, "\"file://" + folder.path("meshes/a.stl") + "\"")) << text;
  EXPECT_TRUE(test::contains(text, "\"package://p/b.stl\"")) << text;
  EXPECT_TRUE(test::contains(text, "\"file:///c.stl\"")) << text;
  EXPECT_TRUE(test::contains(text, "\"file:///d.stl\"")) << text;
}

}  // namespace
}  // namespace palpate::instrument::description_test
