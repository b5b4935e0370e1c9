// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of all targets of a program by the files that are kept here: those that are well are read,
// and those with which something was wrong once are read or refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "palpate/base/error.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"
#include "targets.h"

namespace palpate::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostCut = 2;  // files of a target

std::vector<std::string> filesOf(const std::string& kind, const std::string& target) {
  std::vector<std::string> files;
  const fs::path folder = fs::path(test::sourceFolder()) / "test/fuzz" / kind / target;
  if (!fs::exists(folder)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> namesOfTargets() {
  std::vector<std::string> names;
  for (const Target& target : targets()) names.emplace_back(target.name);
  return names;
}

class HostileFiles : public ::testing::TestWithParam<std::string> {
 protected:
  const Target& target() const { return targetNamed(GetParam()); }
  std::vector<std::string> seeds() const {
    std::vector<std::string> all;
    for (const std::string& file : filesOf("seeds", GetParam()))
      all.push_back(test::fileBytes(file));
    if (target().seeds != nullptr) {
      for (const std::string& bytes : target().seeds()) all.push_back(bytes);
    }
    return all;
  }
};
INSTANTIATE_TEST_SUITE_P(Of, HostileFiles, ::testing::ValuesIn(namesOfTargets()),
                         [](const auto& of) { return of.param; });

TEST_P(HostileFiles, ThatAreWellAreRead) {
  ASSERT_FALSE(seeds().empty());
  for (const std::string& bytes : seeds()) {
    try {
      target().read(bytes);  // what is made once is made here
      EXPECT_EQ(tryBytes(target(), bytes), Outcome::kRead);
    } catch (const InputError& error) {
      ADD_FAILURE() << bytes.substr(0, 60) << ": " << error.what();
    }
  }
}

// Of small ones at every byte.
TEST_P(HostileFiles, ThatAreCutOffAreReadOrRefused) {
  const std::vector<std::string> all = seeds();
  for (const std::string& bytes : all) target().read(bytes);
  for (std::size_t k = 0; k < std::min(all.size(), kMostCut); ++k) {
    for (std::size_t n = 0; n < all[k].size(); n += 1 + all[k].size() / 400) {
      SCOPED_TRACE(std::to_string(k) + " " + std::to_string(n));
      EXPECT_NO_THROW(tryBytes(target(), all[k].substr(0, n)));
    }
  }
}

TEST_P(HostileFiles, ThatWereTroubleAreReadOrRefused) {
  for (const std::string& bytes : seeds()) target().read(bytes);
  for (const std::string& file : filesOf("regressions", GetParam())) {
    SCOPED_TRACE(file);
    EXPECT_NO_THROW(tryBytes(target(), test::fileBytes(file)));
  }
}

}  // namespace
}  // namespace palpate::fuzz
