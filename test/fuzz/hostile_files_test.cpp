// SPDX-License-Identifier: GPL-3.0-or-later
// The folders of the files that are kept; kept_files.cpp has the tests of the files.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/source_folder.h"
#include "targets.h"

namespace palpate::fuzz {
namespace {

namespace fs = std::filesystem;

TEST(HostileFolders, AreOfTargets) {
  for (const char* kind : {"seeds", "regressions"}) {
    const fs::path folder = fs::path(test::sourceFolder()) / "test/fuzz" / kind;
    if (!fs::exists(folder)) continue;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name == "bag") continue;  // of the targets that need ROS
      EXPECT_NO_THROW(targetNamed(name)) << entry.path();
    }
  }
}

}  // namespace
}  // namespace palpate::fuzz
