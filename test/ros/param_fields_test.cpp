// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters replace the keys that they name, and no others.
#include "ros/program/param_fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "palpate/scene/scene.h"
#include "ros/node/params.h"
#include "support/input_error.h"
#include "support/source_folder.h"

namespace palpate::node::param_fields_test {
namespace {

using XmlRpc::XmlRpcValue;

const std::string kScenes = test::sourceFolder() + "/config/scenes/";

std::map<std::string, std::string> valuesOf(const scene::Scene& scene) {
  std::map<std::string, std::string> values;
  for (const keys::KeyValue& value : scene::sceneValues(scene)) values[value.key] = value.value;
  return values;
}

/// A list of structures, as YAML gives them.
XmlRpcValue pairs() {
  XmlRpcValue pair, list;
  pair["instrument"] = std::string("left");
  pair["static"] = 0.6;
  list[0] = pair;
  return list;
}

class ShippedScenes : public ::testing::TestWithParam<std::string> {};

std::vector<std::string> shippedScenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(kScenes)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScenes, ::testing::ValuesIn(shippedScenes()),
                         [](const auto& name) { return name.param; });

TEST_P(ShippedScenes, AreWhatTheirFileSaysWithoutParameters) {
  const std::string file = kScenes + GetParam() + ".yaml";
  EXPECT_EQ(valuesOf(readScene(file, ParamTree())), valuesOf(scene::readScene(file)));
  XmlRpcValue params;
  params["scene"] = GetParam();
  EXPECT_EQ(valuesOf(readScene(file, ParamTree("/node", params))),
            valuesOf(scene::readScene(file)));
}

// All keys of the section are visited, and so are those that a test of none would not notice.
TEST_P(ShippedScenes, ChangeInNoOtherKeyThanThatOfAParameter) {
  const std::string file = kScenes + GetParam() + ".yaml";
  XmlRpcValue params;
  params["contact"]["friction"]["static"] = 0.123;
  params["contact"]["friction"]["kinetic"] = 0.1;
  params["solver"]["skip"]["unwatched_markers"] = false;
  params["rates"]["stale_after"] = 0.25;
  auto expected = valuesOf(scene::readScene(file));
  expected["contact.friction.static"] = "0.123";
  expected["contact.friction.kinetic"] = "0.1";
  expected["solver.skip.unwatched_markers"] = "false";
  expected["rates.stale_after"] = "0.25";
  EXPECT_EQ(valuesOf(readScene(file, ParamTree("/node", params))), expected);
}

std::vector<Problem> refused(const XmlRpcValue& params) {
  return test::problemsOf(
      [&] { readScene(kScenes + "gallbladder_bimanual.yaml", ParamTree("/node", params)); });
}

TEST(ParamFields, RefusesListsThatStandInFilesOnly) {
  XmlRpcValue params, none;
  none.setSize(0);
  params["contact"]["friction"]["pairs"] = pairs();
  params["contact"]["apart"] = none;
  params["instruments"]["left"]["name"] = std::string("hand");
  const std::vector<Problem> problems = refused(params);
  EXPECT_EQ(problems.size(), 3U);
  const std::string why = "cannot be a parameter: change it in the scene file";
  EXPECT_TRUE(test::hasProblem(problems, "contact/friction/pairs", why));
  EXPECT_TRUE(test::hasProblem(problems, "contact/apart", why));
  EXPECT_TRUE(test::hasProblem(problems, "instruments/left/name", why));
  for (const Problem& problem : problems) EXPECT_FALSE(problem.value.empty()) << problem.key;
}

TEST(ParamFields, RefusesValuesInThePlaceOfSections) {
  XmlRpcValue params;
  params["contact"]["friction"] = 0.5;
  params["instruments"]["left"]["proxy"] = std::string("fast");
  params["solver"]["step"]["size"] = 0.01;
  const std::vector<Problem> problems = refused(params);
  EXPECT_EQ(problems.size(), 3U);
  EXPECT_TRUE(test::hasProblem(problems, "contact/friction", "must have keys below it"));
  EXPECT_TRUE(test::hasProblem(problems, "instruments/left/proxy", "must have keys below it"));
  EXPECT_TRUE(test::hasProblem(problems, "solver/step", "must be a number"));
}

TEST(ParamTree, FindsWhatIsSet) {
  XmlRpcValue params;
  params["a"]["b"]["c"] = 1;
  params["a"]["d"] = std::string("text");
  params["e"] = true;
  const ParamTree tree("/node", params);
  EXPECT_EQ(tree.keys(), (std::vector<std::string>{"a/b/c", "a/d", "e"}));
  ASSERT_NE(tree.find("a/b/c"), nullptr);
  EXPECT_EQ(static_cast<const int&>(*tree.find("a/b/c")), 1);
  EXPECT_EQ(tree.find("a/b")->getType(), XmlRpcValue::TypeStruct);
  for (const char* missing : {"", "a/", "/a", "a/b/c/d", "e/f", "b", "a/b/cc"}) {
    EXPECT_EQ(tree.find(missing), nullptr) << missing;
  }
  EXPECT_TRUE(ParamTree().keys().empty());
  EXPECT_EQ(ParamTree().find("a"), nullptr);
}

}  // namespace
}  // namespace palpate::node::param_fields_test
