// SPDX-License-Identifier: GPL-3.0-or-later
// The state that each shipped scene has after the first part of its trajectory, to the bit: a
// change of bits is a decision. Who makes it runs this program, in the environment of
// scripts/env.sh, with PALPATE_WRITE_HASHES=$PWD/test/sim/golden_hashes.csv and commits the file.
//
// Our kernels round alike on every processor. The C library and BLAS choose functions by processor,
// so the program restarts itself with the functions of any x86-64 processor since 2008. Each row
// has a hash of their results; rows of libraries that round differently are skipped.
//
// Each test has a cache of its own, so that a hash does not depend on what this user ran before.
// `--fill SCENE.yaml ...` loads scenes in the environment as it is, which fills its cache.
#include <gtest/gtest.h>
#include <stdlib.h>  // setenv: POSIX
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/scene/scene.h"
#include "palpate/sim/simulator.h"
#include "palpate/sim/state_hash.h"
#include "palpate/solver/blas_rounding.h"
#include "sim/shipped_scenes.h"
#include "support/own_program.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"

namespace palpate::sim {
namespace {

std::string hex(std::uint64_t value) {
  std::ostringstream text;
  text << std::hex << value;
  return text.str();
}

// Of what others compute for us.
std::string roundingOfThisMachine() {
  StateHash hash;
  std::vector<double> values;
  for (int k = 1; k <= 500; ++k) {
    const double x = 0.0137 * k;
    for (const double y : {std::exp(-x), std::log(x), std::pow(x, 1.7), std::sin(x), std::cos(x),
                           std::atan2(x, 3.0), std::cbrt(x), std::hypot(x, 0.3)}) {
      values.push_back(y);
    }
  }
  const std::vector<double> product = solver::blasProduct();
  values.insert(values.end(), product.begin(), product.end());
  for (const char c : solver::blasKernels()) values.push_back(c);
  hash.add(values.data(), values.size());
  return hex(hash.value());
}

std::string hashAtTheEnd(const std::string& name) { return hex(test::hashesOf(name).back()); }

const std::string kFile = palpate::test::sourceFolder() + "/test/sim/golden_hashes.csv";

// From "rounding,scene" to its hash.
std::map<std::string, std::string> readHashes(const std::string& file) {
  std::map<std::string, std::string> all;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t comma = line.rfind(',');
    if (comma != std::string::npos) all[line.substr(0, comma)] = line.substr(comma + 1);
  }
  return all;
}

bool writeHashes(const std::string& file, const std::map<std::string, std::string>& all) {
  std::ofstream out(file);
  out << "rounding,scene,hash\n";
  for (const auto& [key, hash] : all) {
    if (key != "rounding,scene") out << key << "," << hash << "\n";
  }
  return static_cast<bool>(out.flush());
}

constexpr char kFill[] = "--fill";

std::string sceneFile(const std::string& name) {
  return palpate::test::sourceFolder() + "/config/scenes/" + name + ".yaml";
}

std::map<std::string, std::string> filesOf(const std::string& folder) {
  namespace fs = std::filesystem;
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[fs::relative(entry.path(), folder).string()] =
        palpate::test::fileBytes(entry.path().string());
  }
  return files;
}

// Of which loading makes a database and keeps it.
std::vector<std::string> scenesThatLearn() {
  std::vector<std::string> names;
  for (const std::string& name : test::shippedScenes()) {
    const scene::Scene scene = scene::readScene(sceneFile(name));
    if (std::any_of(scene.organs.begin(), scene.organs.end(), [](const scene::OrganConfig& organ) {
          return organ.model == "enriched" && organ.enriched.database.empty();
        })) {
      names.push_back(name);
    }
  }
  return names;
}

class GoldenHash : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, GoldenHash, ::testing::ValuesIn(test::shippedScenes()),
                         [](const auto& name) { return name.param; });

// With a cache that is empty at first.
TEST_P(GoldenHash, IsThatOfTheFile) {
  const palpate::test::TempFolder folder;
  setenv("XDG_CACHE_HOME", folder.path("cache").c_str(), 1);
  const std::string key = roundingOfThisMachine() + "," + GetParam();
  std::map<std::string, std::string> golden = readHashes(kFile);
  if (const char* file = std::getenv("PALPATE_WRITE_HASHES")) {
    golden = readHashes(file);
    golden[key] = hashAtTheEnd(GetParam());
    ASSERT_TRUE(writeHashes(file, golden)) << file;
    return;
  }
  const std::string rounding = key.substr(0, key.find(','));
  const bool known = std::any_of(golden.begin(), golden.end(), [&](const auto& entry) {
    return entry.first.compare(0, rounding.size(), rounding) == 0;
  });
  if (!known)
    GTEST_SKIP() << "this C library or BLAS rounds as no line of " << kFile
                 << " says: " << rounding;
  ASSERT_TRUE(golden.count(key)) << "a scene without a hash: run with PALPATE_WRITE_HASHES="
                                 << kFile;
  EXPECT_EQ(hashAtTheEnd(GetParam()), golden[key]);
}

// A scene that learns, of few presses.
std::string fewPresses(const std::string& name) {
  std::string text = palpate::test::fileBytes(sceneFile(name));
  text = std::regex_replace(text, std::regex("samples: [0-9]+"), "samples: 3");
  return std::regex_replace(text, std::regex("\\.\\./"),
                            palpate::test::sourceFolder() + "/config/");
}

class HashOfLearned : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, HashOfLearned, ::testing::ValuesIn(scenesThatLearn()),
                         [](const auto& name) { return name.param; });

TEST_P(HashOfLearned, IsTheSameWhoeverFilledTheCache) {
  const palpate::test::TempFolder folder;
  const std::string file = folder.write("scene.yaml", fewPresses(GetParam()));
  const auto hash = [&] { return hex(test::hashesOfFile(file, GetParam()).back()); };
  setenv("XDG_CACHE_HOME", folder.path("empty").c_str(), 1);
  const std::string fresh = hash();
  EXPECT_EQ(hash(), fresh) << "filled by this process";
  setenv("XDG_CACHE_HOME", folder.path("filled").c_str(), 1);
  palpate::test::runThisProgram(palpate::test::kOwnKernels, kFill + (" " + file));
  EXPECT_FALSE(filesOf(folder.path("filled")).empty());
  EXPECT_EQ(hash(), fresh) << "filled with the machine's own kernels";
}

// Loads these scene files.
int fill(const std::vector<std::string>& files) {
  for (const std::string& file : files) Simulator(scene::readScene(file));
  return 0;
}

// Whether it had another value.
bool setTo(const char* name, const char* value) {
  const char* before = getenv(name);
  return (before == nullptr || std::string_view(before) != value) && setenv(name, value, 1) == 0;
}

}  // namespace
}  // namespace palpate::sim

int main(int argc, char** argv) {
  using palpate::sim::setTo;
  if (argc > 1 && std::string_view(argv[1]) == palpate::sim::kFill) {
    return palpate::sim::fill({argv + 2, argv + argc});
  }
  const bool threads = setTo("OPENBLAS_NUM_THREADS", "1");
  const bool blas = setTo("OPENBLAS_CORETYPE", "NEHALEM");
  const bool c_library = setTo("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4");
  if (threads || blas || c_library) execv("/proc/self/exe", argv);  // read before main()
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
