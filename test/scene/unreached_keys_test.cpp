// SPDX-License-Identifier: GPL-3.0-or-later
// A visitor that does not reach a key leaves it as it is, and the list of values has every key.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/number.h"
#include "palpate/keys/value_list.h"
#include "palpate/keys/yaml_reader.h"
#include "palpate/scene/scene.h"
#include "palpate/scene/scene_fields.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::keys::unreached_keys_test {

/// Finds nothing. `enters`: goes into the items of lists all the same.
class Nothing final : public FieldVisitor {
 public:
  explicit Nothing(bool enters) : enters_(enters) {}

  bool number(const Field&, double&, const Range&) override { return false; }
  bool integer(const Field&, int&, const Range&) override { return false; }
  bool flag(const Field&, bool&) override { return false; }
  bool text(const Field&, std::string&) override { return false; }
  bool name(const Field&, std::string&) override { return false; }
  bool choice(const Field&, std::string&, const std::vector<std::string>&) override {
    return false;
  }
  bool vector3(const Field&, Vec3&, const Range&) override { return false; }
  bool vectors3(const Field&, std::vector<Vec3>&, const Range&, int) override { return false; }
  bool integers3(const Field&, Eigen::Vector3i&, const Range&) override { return false; }
  bool partialVector3(const Field&, PartialVec3&, const Range&) override { return false; }
  bool numbersOfKind(const std::string&, const std::vector<Kind>&, const std::string&,
                     NumberLists&) override {
    return false;
  }
  void rule(bool, const std::string&, const std::string&) override {}

 protected:
  Entered enterSection(const Field&) override { return {false, true}; }
  Entered enterNumberOrSection(const Field&, double&, const Range&) override {
    return {false, true};
  }
  Items enterList(const Field&, int, int present) override {
    return {enters_ ? present : 0, false};
  }
  bool enterItem(const Field&, int) override { return true; }
  void leaveSection() override {}
  void beginAlternative(bool, const std::string&) override {}
  void endAlternative() override {}

 private:
  bool enters_;
};

namespace {

struct Item {
  std::string name;
  double number = 1.0;
};
void describe(FieldVisitor& v, Item& item) {
  v.name({"name", "", ""}, item.name);
  v.number({"number", "", ""}, item.number, Range::any());
}

/// A key of each kind that a visitor has.
struct All {
  double number = 0.0;
  int integer = 0;
  bool flag = false;
  std::string text, name, choice = "one";
  Vec3 vector3 = Vec3::Zero();
  std::vector<Vec3> vectors3;
  Eigen::Vector3i integers3 = Eigen::Vector3i::Zero();
  PartialVec3 partial;
  NumberLists constants;
  std::optional<double> perhaps_number, no_number;
  std::optional<int> perhaps_integer, no_integer;
  std::optional<Vec3> perhaps_vector, no_vector;
  std::optional<PartialVec3> perhaps_partial, no_partial;
  Item section, short_form;
  std::optional<Item> perhaps_section, no_section;
  std::vector<Item> list, empty;
  double chosen = 0.0, other = 0.0;
};

void describe(FieldVisitor& v, All& a) {
  const Range any = Range::any();
  v.number({"number", "", ""}, a.number, any);
  v.integer({"integer", "", ""}, a.integer, any);
  v.flag({"flag", "", ""}, a.flag);
  v.text({"text", "", ""}, a.text);
  v.name({"name", "", ""}, a.name);
  v.choice({"choice", "", ""}, a.choice, {"one", "two"});
  v.vector3({"vector3", "", ""}, a.vector3, any);
  v.vectors3({"vectors3", "", ""}, a.vectors3, any, 0);
  v.integers3({"integers3", "", ""}, a.integers3, any);
  v.partialVector3({"partial", "", ""}, a.partial, any);
  v.numbersOfKind("choice", {{"one", {"c"}, ""}, {"two", {"c", "d"}, ""}}, a.choice, a.constants);
  v.number({"perhaps_number", "", ""}, a.perhaps_number, any);
  v.number({"no_number", "", ""}, a.no_number, any);
  v.integer({"perhaps_integer", "", ""}, a.perhaps_integer, any);
  v.integer({"no_integer", "", ""}, a.no_integer, any);
  v.vector3({"perhaps_vector", "", ""}, a.perhaps_vector, any);
  v.vector3({"no_vector", "", ""}, a.no_vector, any);
  v.partialVector3({"perhaps_partial", "", ""}, a.perhaps_partial, any);
  v.partialVector3({"no_partial", "", ""}, a.no_partial, any);
  v.section({"section", "", ""}, a.section);
  v.numberOrSection({"short_form", "", ""}, a.short_form.number, any, a.short_form);
  v.section({"perhaps_section", "", ""}, a.perhaps_section);
  v.section({"no_section", "", ""}, a.no_section);
  v.list({"list", "", ""}, a.list, 0);
  v.list({"empty", "", ""}, a.empty, 0);
  v.onlyIf(a.choice == "two", "two", [&] { v.number({"chosen", "", ""}, a.chosen, any); });
  v.onlyIf(a.choice == "one", "one", [&] { v.number({"other", "", ""}, a.other, any); });
}

constexpr char kAll[] = R"(number: 0.1
integer: 7
flag: true
text: some words
name: a_name
choice: two
vector3: [1, 2.5, 3]
vectors3: [[1, 2, 3], [4, 5, 6]]
integers3: [1, 2, 3]
partial: [1, null, 3]
c: 5
d: [6, 7]
perhaps_number: 0
perhaps_integer: 0
perhaps_vector: [0, 0, 0]
perhaps_partial: [null, null, null]
section: {name: s, number: 2}
short_form: 4
perhaps_section: {name: "p", number: 3}
list: [{name: l0}, {name: l1, number: 9}]
chosen: 11
)";

std::vector<KeyValue> values(All all) {
  return fieldValues([&](FieldVisitor& v) { describe(v, all); });
}

std::string lines(const std::vector<KeyValue>& all) {
  std::string text;
  for (const KeyValue& value : all) text += value.key + ": " + value.value + "\n";
  return text;
}

All readAll(const std::string& text) {
  const test::TempFolder folder;
  All all;
  readYaml(folder.write("all.yaml", text), [&](FieldVisitor& v) { describe(v, all); });
  return all;
}

TEST(ValueList, HasEachKindOfKey) {
  EXPECT_EQ(lines(values(readAll(kAll))),
            "number: 0.1\ninteger: 7\nflag: true\ntext: some words\nname: a_name\nchoice: two\n"
            "vector3: [1, 2.5, 3]\nvectors3: [[1, 2, 3], [4, 5, 6]]\nintegers3: [1, 2, 3]\n"
            "partial: [1, null, 3]\nc: 5\nd: [6, 7]\nperhaps_number: 0\nperhaps_integer: 0\n"
            "perhaps_vector: [0, 0, 0]\nperhaps_partial: [null, null, null]\nsection.name: s\n"
            "section.number: 2\nshort_form.name: \nshort_form.number: 4\nperhaps_section.name: p\n"
            "perhaps_section.number: 3\nlist[0].name: l0\nlist[0].number: 1\nlist[1].name: l1\n"
            "list[1].number: 9\nchosen: 11\n");
}

TEST(Unreached, KeepsEachKindOfKey) {
  All all = readAll(kAll);
  const std::vector<KeyValue> before = values(all);
  for (const bool enters : {false, true}) {
    Nothing nothing(enters);
    describe(nothing, all);
    EXPECT_EQ(lines(values(all)), lines(before)) << enters;
  }
  EXPECT_FALSE(all.no_number || all.no_integer || all.no_vector || all.no_partial ||
               all.no_section);
}

// Lists that stand in a file take the place of what was there; those that do not, leave it.
TEST(Unreached, OnlyWhatStandsInAFileReplaces) {
  const test::TempFolder folder;
  All all = readAll(kAll);
  const auto read = [&](const std::string& text) {
    readYaml(folder.write("more.yaml", text), [&](FieldVisitor& v) { describe(v, all); });
  };
  read("number: 5\n");
  ASSERT_EQ(all.list.size(), 2U);
  EXPECT_EQ(all.list[1].number, 9.0);
  EXPECT_EQ(all.number, 5.0);
  read("list: [{name: x}]\n");
  ASSERT_EQ(all.list.size(), 1U);
  EXPECT_EQ(all.list[0].number, 1.0);
  read("list: []\n");
  EXPECT_TRUE(all.list.empty());
}

/// Words and numbers that stand in a scene file, by their keys; of a list of numbers its text.
void addLeaves(const YAML::Node& node, const std::string& key,
               std::map<std::string, std::string>* leaves) {
  if (node.IsMap()) {
    for (const auto& entry : node) {
      addLeaves(entry.second, (key.empty() ? "" : key + ".") + entry.first.as<std::string>(),
                leaves);
    }
  } else if (node.IsSequence() && node.size() > 0 && node[0].IsMap()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      addLeaves(node[i], key + "[" + std::to_string(i) + "]", leaves);
    }
  } else if (node.IsSequence()) {
    std::string text;
    for (const YAML::Node& item : node) {
      std::map<std::string, std::string> inside;
      addLeaves(item, "", &inside);
      text += (text.empty() ? "" : ", ") + inside[""];
    }
    (*leaves)[key] = "[" + text + "]";
  } else {
    const auto number = parseNumber(node.Scalar());
    (*leaves)[key] = number ? formatNumber(*number) : node.Scalar();
  }
}

class ShippedScenes : public ::testing::TestWithParam<std::string> {
 protected:
  const std::string file_ = test::sourceFolder() + "/config/scenes/" + GetParam() + ".yaml";
};

std::vector<std::string> shippedScenes() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::sourceFolder() + "/config/scenes")) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScenes, ::testing::ValuesIn(shippedScenes()),
                         [](const auto& name) { return name.param; });

TEST_P(ShippedScenes, KeepAllKeysThatNobodyReaches) {
  scene::Scene scene = scene::readScene(file_);
  const std::string before = lines(scene::sceneValues(scene));
  for (const bool enters : {false, true}) {
    Nothing nothing(enters);
    scene::describe(nothing, scene);
    EXPECT_EQ(lines(scene::sceneValues(scene)), before) << enters;
  }
}

TEST_P(ShippedScenes, AreToldWithAllTheirKeys) {
  std::map<std::string, std::string> told, leaves;
  for (const KeyValue& value : scene::sceneValues(scene::readScene(file_))) {
    EXPECT_TRUE(told.emplace(value.key, value.value).second) << value.key << " twice";
  }
  addLeaves(YAML::LoadFile(file_), "", &leaves);
  ASSERT_GT(leaves.size(), 8U);
  for (const auto& [key, value] : leaves) {
    const bool is_short = key.size() > 11 && key.rfind(".edge_length") == key.size() - 12;
    const std::string whole = is_short ? key + ".coarsest" : key;
    ASSERT_TRUE(told.count(whole)) << whole << " is not told";
    EXPECT_EQ(told.at(whole), value) << whole;
  }
}

}  // namespace
}  // namespace palpate::keys::unreached_keys_test
