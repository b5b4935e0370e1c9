// SPDX-License-Identifier: GPL-3.0-or-later
// What is shipped is found by its name, has a trajectory that fits, and says how fast it runs.
#include "start/shipped.h"

#include <gtest/gtest.h>
#include <stdlib.h>  // setenv: POSIX

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "palpate/base/number.h"
#include "palpate/formats/trajectory.h"
#include "palpate/io/joint_columns.h"
#include "palpate/scene/scene_parts.h"
#include "support/contains.h"
#include "support/input_error.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::start::shipped_test {
namespace {

namespace fs = std::filesystem;
using test::complaint;
using test::contains;

/// A variable of the environment that is set, or not (nullptr), until the object ends.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    const char* before = getenv(name);
    was_set_ = before != nullptr;
    if (was_set_) before_ = before;
    set(value);
  }
  ~Variable() { set(was_set_ ? before_.c_str() : nullptr); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void set(const char* value) const {
    if (value == nullptr) {
      unsetenv(name_);
    } else {
      setenv(name_, value, 1);
    }
  }
  const char* name_;
  bool was_set_;
  std::string before_;
};

/// The working folder until the object ends.
class WorkingFolder {
 public:
  explicit WorkingFolder(const fs::path& folder) : before_(fs::current_path()) {
    fs::current_path(folder);
  }
  ~WorkingFolder() { fs::current_path(before_); }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

 private:
  fs::path before_;
};

class Shipped : public ::testing::Test {
  const Variable share_{"PALPATE_SHARE", nullptr};
};

TEST_F(Shipped, AreTheFilesInConfig) {
  const fs::path scenes = fs::path(test::sourceFolder()) / "config" / "scenes";
  const std::vector<std::string> names = shippedScenes();
  EXPECT_EQ(names.size(), static_cast<std::size_t>(std::distance(fs::directory_iterator(scenes),
                                                                 fs::directory_iterator())));
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  for (const std::string& name : names) {
    EXPECT_TRUE(fs::equivalent(sceneFile(name), scenes / (name + ".yaml"))) << name;
  }
}

TEST_F(Shipped, ANameThatIsNoneIsRefusedWithTheNearestAndAll) {
  const std::string said = complaint([] { sceneFile("liver_palpatoin"); });
  EXPECT_TRUE(contains(said, "liver_palpatoin: is no file and no shipped scene"));
  EXPECT_TRUE(contains(said, "did you mean liver_palpation?"));
  for (const std::string& name : shippedScenes()) EXPECT_TRUE(contains(said, name));
  EXPECT_FALSE(contains(complaint([] { sceneFile("xyz"); }), "did you mean"));
}

TEST_F(Shipped, WhatIsAFileStaysOne) {
  for (const char* name : {"slab_probe.yaml", "./slab_probe", "/nowhere/slab_probe"}) {
    EXPECT_EQ(sceneFile(name), name);
  }
  const test::TempFolder folder;
  folder.write("slab_probe", "a file of this name");
  const WorkingFolder here(folder.path(""));
  EXPECT_EQ(sceneFile("slab_probe"), "slab_probe");
}

TEST_F(Shipped, APackageIsLookedFor) {
  const WorkingFolder here(test::sourceFolder());
  EXPECT_TRUE(fs::equivalent(sceneFile("package://palpate/config/scenes/slab_probe.yaml"),
                             sceneFile("slab_probe")));
  EXPECT_TRUE(contains(complaint([] { sceneFile("package://nobody_has_it/a.yaml"); }),
                       "package 'nobody_has_it' is not found"));
}

TEST_F(Shipped, TheEnvironmentSaysWhere) {
  const test::TempFolder folder;
  folder.write("config/scenes/mine.yaml", "");
  folder.write("config/scenes/mine_too.yaml", "");
  folder.write("config/scenes/notes.txt", "");
  const Variable share("PALPATE_SHARE", folder.path("").c_str());
  EXPECT_EQ(shippedScenes(), (std::vector<std::string>{"mine", "mine_too"}));
  EXPECT_EQ(sceneFile("mine"), folder.path("config/scenes/mine.yaml"));
  EXPECT_EQ(shippedTrajectory(sceneFile("mine")), "");

  const std::string shared = folder.write("config/trajectories/mine_three.csv", "");
  EXPECT_EQ(shippedTrajectory(sceneFile("mine")), shared);
  EXPECT_EQ(shippedTrajectory(sceneFile("mine_too")), shared);
  const std::string own = folder.write("config/trajectories/mine.csv", "");
  EXPECT_EQ(shippedTrajectory(sceneFile("mine")), own);
  EXPECT_EQ(shippedTrajectory(sceneFile("mine_too")), "") << "two that it might share";
  EXPECT_EQ(shippedTrajectory(folder.write("elsewhere/mine.yaml", "")), "");

  const Variable wrong("PALPATE_SHARE", "/nowhere");
  EXPECT_TRUE(contains(complaint([] { shippedScenes(); }),
                       "PALPATE_SHARE = /nowhere: must be a folder that has config/scenes"));
}

// That their replays converge is in golden_hash_test and in the tests of each scene.
TEST_F(Shipped, EveryScenesTrajectoryFitsItsJoints) {
  for (const std::string& name : shippedScenes()) {
    const std::string file = shippedTrajectory(sceneFile(name));
    ASSERT_NE(file, "") << name;
    const scene::Scene scene = scene::readScene(sceneFile(name));
    const std::vector<instrument::Instrument> instruments = scene::readInstruments(scene);
    std::vector<io::InstrumentJoints> joints;
    for (std::size_t i = 0; i < instruments.size(); ++i) {
      joints.push_back({scene.instruments[i].name, instruments[i].jointNames()});
    }
    EXPECT_NO_THROW(io::jointColumns(formats::readTrajectory(file), joints, file)) << name;
  }
}

/// The lines of # at the beginning of a file, as one.
std::string firstComment(const std::string& file) {
  std::istringstream lines(test::fileBytes(file));
  std::string text;
  for (std::string line; std::getline(lines, line) && line.rfind('#', 0) == 0;) {
    text += line.substr(1);
  }
  return text;
}

/// The rows of the table of scenes in docs/scenes.md by the scenes that their first cells name.
std::map<std::string, std::string> rowsOfScenes() {
  std::istringstream page(test::fileBytes(test::sourceFolder() + "/docs/scenes.md"));
  std::map<std::string, std::string> rows;
  bool here = false;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("## ", 0) == 0) here = line == "## Shipped scenes";
    if (!here || line.rfind("| `", 0) != 0) continue;
    std::istringstream cell(line.substr(1, line.find('|', 1) - 1));
    for (std::string part; std::getline(cell, part, '`');) {
      std::string name;
      if (std::getline(cell, name, '`')) rows[name] = line;
    }
  }
  return rows;
}

TEST_F(Shipped, EachRunsAtRealTimeOrSaysHowFast) {
  const std::map<std::string, std::string> rows = rowsOfScenes();
  for (const std::string& name : shippedScenes()) {
    const std::string file = sceneFile(name), comment = firstComment(file);
    const scene::Scene scene = scene::readScene(file);
    const double speed = scene.rates.simulation * scene.solver.step;
    ASSERT_EQ(rows.count(name), 1U) << name << " has no row in docs/scenes.md";
    if (std::abs(speed - 1.0) < 1e-9) {
      EXPECT_FALSE(contains(comment, "of real time")) << name;
      EXPECT_FALSE(contains(rows.at(name), "of real time")) << name;
    } else {
      const std::string said = formatNumber(speed) + " of real time";
      EXPECT_TRUE(contains(comment, said)) << name;
      EXPECT_TRUE(contains(rows.at(name), said)) << name;
    }
  }
  EXPECT_EQ(rows.size(), shippedScenes().size());
}

}  // namespace
}  // namespace palpate::start::shipped_test
