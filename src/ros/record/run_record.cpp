// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_record.h"

#include <filesystem>
#include <map>

#include "build_info.h"
#include "palpate/base/text_file.h"
#include "scene_files.h"
#include "sha256.h"

namespace palpate::node {
namespace {

constexpr std::size_t kMaxSceneFile = std::size_t{1} << 24;  // [bytes]
constexpr std::size_t kShownDigits = 12;                     // of a sha256

using Words = std::map<std::string, std::string>;

Words wordsOf(const std::vector<diagnostic_msgs::KeyValue>& all) {
  Words words;
  for (const diagnostic_msgs::KeyValue& word : all) words[word.key] = word.value;
  return words;
}

Words valuesOf(const scene::Scene& scene) {
  Words words;
  for (const keys::KeyValue& value : scene::sceneValues(scene)) words[value.key] = value.value;
  return words;
}

diagnostic_msgs::KeyValue keyValue(const std::string& key, const std::string& value) {
  diagnostic_msgs::KeyValue both;
  both.key = key;
  both.value = value;
  return both;
}

std::string shownHash(const std::string& sha256) {
  return sha256.empty() ? "unreadable" : "sha256 " + sha256.substr(0, kShownDigits);
}

std::string fileName(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

// Calls `differs(key, before, now)` for each key whose values are not the same; nullptr: it has
// none.
template <class Value, class Differs>
void compareMaps(const std::map<std::string, Value>& before,
                 const std::map<std::string, Value>& now, Differs&& differs) {
  for (const auto& [key, value] : before) {
    const auto other = now.find(key);
    const Value* there = other == now.end() ? nullptr : &other->second;
    if (!there || !(*there == value)) differs(key, &value, there);
  }
  for (const auto& [key, value] : now) {
    if (!before.count(key)) differs(key, nullptr, &value);
  }
}

}  // namespace

palpate::RunRecord recordOf(const scene::Scene& scene, const std::string& initial_state,
                            const ros::Time& stamp) {
  palpate::RunRecord record;
  record.header.stamp = stamp;
  record.version = buildVersion();
  record.commit = buildCommit();
  record.scene = scene.file;
  record.scene_text = readTextFile(scene.file, kMaxSceneFile);
  const Words of_file = valuesOf(scene::readScene(scene.file));
  for (const keys::KeyValue& value : scene::sceneValues(scene)) {
    record.keys.push_back(keyValue(value.key, value.value));
    const auto before = of_file.find(value.key);
    const std::string& text = before == of_file.end() ? std::string() : before->second;
    if (text != value.value) record.replaced.push_back(keyValue(value.key, text));
  }
  record.files = sceneFiles(scene);
  if (!initial_state.empty()) {
    palpate::RecordedFile file;
    file.key = "~initial_state";
    file.path = initial_state;
    file.sha256 = sha256OfFile(initial_state);
    record.files.push_back(file);
  }
  return record;
}

std::vector<std::string> differences(const palpate::RunRecord& recorded,
                                     const palpate::RunRecord& now) {
  std::vector<std::string> lines;
  const Words replaced = wordsOf(recorded.replaced);
  compareMaps(wordsOf(recorded.keys), wordsOf(now.keys),
              [&](const std::string& key, const std::string* before, const std::string* after) {
                lines.push_back(key + ": " + (before ? *before : "nothing") + " then, " +
                                (after ? *after : "nothing") + " now" +
                                (replaced.count(key) ? " (a parameter had replaced it)" : ""));
              });
  std::map<std::string, std::string> files, files_now, names;
  for (const palpate::RecordedFile& file : recorded.files) files[file.key] = file.sha256;
  for (const palpate::RecordedFile& file : now.files) files_now[file.key] = file.sha256;
  for (const auto* all : {&recorded.files, &now.files}) {
    for (const palpate::RecordedFile& file : *all) names[file.key] = fileName(file.path);
  }
  compareMaps(files, files_now,
              [&](const std::string& key, const std::string* before, const std::string* after) {
                lines.push_back(names[key] + " (" + key +
                                "): " + (before ? shownHash(*before) : "not there") + " then, " +
                                (after ? shownHash(*after) : "not there") + " now");
              });
  return lines;
}

std::string programOf(const palpate::RunRecord& record) {
  return record.version + ", commit " + (record.commit.empty() ? "unknown" : record.commit);
}

}  // namespace palpate::node
