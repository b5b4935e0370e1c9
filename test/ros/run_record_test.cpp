// SPDX-License-Identifier: GPL-3.0-or-later
// A record of a run names all that the scene reads, and differs where another run would.
#include "ros/record/run_record.h"

#include <gtest/gtest.h>
#include <ros/serialization.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "ros/node/params.h"
#include "ros/record/build_info.h"
#include "ros/record/sha256.h"
#include "ros/replay/message_bytes.h"
#include "support/contains.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::node::run_record_test {
namespace {

namespace fs = std::filesystem;

const std::string kConfig = test::sourceFolder() + "/config/";

std::map<std::string, std::string> filesOf(const palpate::RunRecord& record) {
  std::map<std::string, std::string> files;
  for (const palpate::RecordedFile& file : record.files) {
    EXPECT_TRUE(files.emplace(file.key, file.path).second) << file.key << " twice";
    EXPECT_EQ(file.sha256.size(), 64U) << file.path;
  }
  return files;
}

std::string valueOf(const std::vector<diagnostic_msgs::KeyValue>& all, const std::string& key) {
  for (const diagnostic_msgs::KeyValue& one : all) {
    if (one.key == key) return one.value;
  }
  return "none";
}

palpate::RunRecord recordOfFile(const std::string& file) {
  return recordOf(scene::readScene(file), "", ros::Time(1.0));
}

TEST(Sha256, IsThatOfTheStandard) {  // FIPS 180-2, and of nothing
  const test::TempFolder folder;
  EXPECT_EQ(sha256OfFile(folder.write("abc", "abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256OfFile(folder.write("none", "")),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256OfFile(folder.write("million", std::string(1000000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(sha256OfFile(folder.path("missing")), "");
  EXPECT_EQ(sha256OfFile(folder.path("")), "");
}

class RecordsOfScenes : public ::testing::TestWithParam<std::string> {};

std::vector<std::string> shippedScenes() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kConfig + "scenes")) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, RecordsOfScenes, ::testing::ValuesIn(shippedScenes()),
                         [](const auto& name) { return name.param; });

// Whatever in the file, comments apart, looks like a path is among the files, which are there.
TEST_P(RecordsOfScenes, NameAllTheirFiles) {
  const std::string file = kConfig + "scenes/" + GetParam() + ".yaml";
  const palpate::RunRecord record = recordOfFile(file);
  EXPECT_EQ(record.scene_text, test::fileBytes(file));
  EXPECT_TRUE(record.replaced.empty());
  std::vector<std::string> found;
  for (const auto& [key, path] : filesOf(record)) found.push_back(fs::canonical(path).string());
  EXPECT_EQ(found.size(), record.files.size());
  const std::string text = std::regex_replace(record.scene_text, std::regex("#.*"), "");
  const std::regex path("\\.\\./[A-Za-z0-9_./]+");
  int count = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), path), end; it != end; ++it, ++count) {
    const std::string named = fs::canonical(kConfig + "scenes/" + it->str()).string();
    EXPECT_TRUE(std::count(found.begin(), found.end(), named)) << named;
  }
  EXPECT_GE(count, 1);
}

TEST_P(RecordsOfScenes, DoNotDifferFromThemselves) {
  const std::string file = kConfig + "scenes/" + GetParam() + ".yaml";
  EXPECT_EQ(differences(recordOfFile(file), recordOfFile(file)), std::vector<std::string>());
}

TEST(RunRecord, SaysWhatProgramRanAndWhatParametersReplaced) {
  XmlRpc::XmlRpcValue params;
  params["contact"]["friction"]["static"] = 0.4;
  const std::string file = kConfig + "scenes/gallbladder_bimanual.yaml";
  const palpate::RunRecord record =
      recordOf(readScene(file, ParamTree("/node", params)), "", ros::Time(1.0));
  EXPECT_EQ(record.version, buildVersion());
  EXPECT_EQ(record.commit, buildCommit());
  EXPECT_TRUE(std::regex_match(record.commit, std::regex("([0-9a-f]{7,40}\\+?)?")))
      << record.commit;
  EXPECT_EQ(valueOf(record.keys, "contact.friction.static"), "0.4");
  EXPECT_EQ(valueOf(record.keys, "contact.friction.pairs[3].teeth"), "20000");
  EXPECT_EQ(valueOf(record.keys, "rates.haptic"), "1000");  // a default
  ASSERT_EQ(record.replaced.size(), 1U);
  EXPECT_EQ(record.replaced[0].key, "contact.friction.static");
  EXPECT_EQ(record.replaced[0].value, valueOf(recordOfFile(file).keys, "contact.friction.static"));
  const std::vector<std::string> lines = differences(record, recordOfFile(file));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0], "contact.friction.static: 0.4 then, 0 now (a parameter had replaced it)");
}

TEST(RunRecord, DiffersWhereAFileHasChanged) {
  const test::TempFolder folder;
  const std::string scene =
      "organs:\n  - name: block\n    tetrahedra: block.msh\n"
      "    material: {file: soft.yaml}\n    enriched: {database: data}\n"
      "instruments:\n  - {name: tool, urdf: tool.urdf, control_frame: tip}\n";
  const std::string urdf =
      "<robot name=\"tool\"><link name=\"tip\"><visual><geometry><mesh filename=\"seen.stl\"/>"
      "</geometry></visual><collision><geometry><mesh filename=\"felt.stl\"/></geometry>"
      "</collision></link></robot>";
  const std::string file = folder.write("scene.yaml", scene);
  folder.write("tool.urdf", urdf);
  for (const char* name : {"block.msh", "soft.yaml", "data/a.bin", "data/b/c.bin", "seen.stl",
                           "felt.stl", "state", "tip", "tool/not_a_file_of_the_scene"}) {
    folder.write(name, name);
  }
  const std::string state = folder.path("state");
  const auto record = [&] { return recordOf(scene::readScene(file), state, ros::Time(1.0)); };
  const palpate::RunRecord before = record();
  const std::map<std::string, std::string> expected = {
      {"scene", "scene.yaml"},
      {"organs[0].tetrahedra", "block.msh"},
      {"organs[0].material.file", "soft.yaml"},
      {"organs[0].enriched.database/a.bin", "data/a.bin"},
      {"organs[0].enriched.database/b/c.bin", "data/b/c.bin"},
      {"instruments[0].urdf", "tool.urdf"},
      {"instruments[0].urdf seen.stl", "seen.stl"},
      {"instruments[0].urdf felt.stl", "felt.stl"},
      {"instruments[0].control_frame", "tip"},  // a text that is the name of a file, by chance
      {"~initial_state", "state"}};
  std::map<std::string, std::string> named;
  for (const auto& [key, path] : expected) named[key] = folder.path(path);
  EXPECT_EQ(filesOf(before), named);

  for (const char* name : {"block.msh", "soft.yaml", "data/b/c.bin", "seen.stl", "state"}) {
    const std::string bytes = test::fileBytes(folder.path(name));
    folder.write(name, bytes + "more");
    const std::vector<std::string> lines = differences(before, record());
    ASSERT_EQ(lines.size(), 1U) << name;
    EXPECT_TRUE(test::contains(lines[0], fs::path(name).filename().string() + " ("));
    EXPECT_TRUE(test::contains(lines[0], " then, sha256 "));
    folder.write(name, bytes);
  }
  EXPECT_TRUE(differences(before, record()).empty());

  fs::remove(folder.path("seen.stl"));
  folder.write("data/new.bin", "");
  folder.write("scene.yaml", scene + "name: changed\n");
  const std::vector<std::string> lines = differences(before, record());
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0], "name:  then, changed now");
  EXPECT_TRUE(test::contains(lines[1], "seen.stl (instruments[0].urdf seen.stl): sha256 "));
  EXPECT_TRUE(test::contains(lines[1], "then, unreadable now"));
  EXPECT_TRUE(test::contains(lines[2], "scene.yaml (scene): sha256 "));
  EXPECT_TRUE(
      test::contains(lines[3], "new.bin (organs[0].enriched.database/new.bin): not there then"));
}

// Those of another scene at another place of the same name are the same, if its files are.
TEST(RunRecord, DoesNotDependOnWhereFilesLie) {
  const test::TempFolder a, b;
  const std::string scene =
      "organs:\n  - {name: block, tetrahedra: block.msh, material: {file: soft.yaml}}\n";
  for (const test::TempFolder* folder : {&a, &b}) {
    folder->write("scene.yaml", scene);
    folder->write("block.msh", "mesh");
    folder->write("soft.yaml", "tissue");
  }
  EXPECT_TRUE(
      differences(recordOfFile(a.path("scene.yaml")), recordOfFile(b.path("scene.yaml"))).empty());
}

TEST(RunRecord, IsAMessageUpToItsLastByteOnly) {
  const palpate::RunRecord record = recordOfFile(kConfig + "scenes/gallbladder_bimanual.yaml");
  std::string bytes(ros::serialization::serializationLength(record), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(&bytes[0]),
                                     static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, record);
  const palpate::RunRecord* const type = nullptr;
  EXPECT_TRUE(areMessage(bytes, type));
  for (std::size_t size = 0; size < bytes.size(); size += size < 200 ? 1 : 101) {
    EXPECT_FALSE(areMessage(std::string_view(bytes).substr(0, size), type)) << size;
  }
  EXPECT_FALSE(areMessage(std::string_view(bytes).substr(0, bytes.size() - 1), type));
}

}  // namespace
}  // namespace palpate::node::run_record_test
