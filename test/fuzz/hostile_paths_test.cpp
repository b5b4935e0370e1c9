// SPDX-License-Identifier: GPL-3.0-or-later
// What stands in the place of a file and is none, or has no end.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <functional>

#include "palpate/analysis/case.h"
#include "palpate/enrichment/database_folder.h"
#include "palpate/enrichment/surrogate_file.h"
#include "palpate/formats/surface_io.h"
#include "palpate/formats/tet_io.h"
#include "palpate/formats/trajectory.h"
#include "palpate/instrument/instrument.h"
#include "palpate/io/state_file.h"
#include "palpate/scene/scene.h"
#include "palpate/scene/tissue_file.h"
#include "palpate/springs/springs_file.h"
#include "support/contains.h"
#include "support/heap_peak.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate {
namespace {

struct Reader {
  const char* name;
  std::string file;  ///< Its name, with the extension that says what it is.
  std::function<void(const std::string&)> read;
};
void PrintTo(const Reader& reader, std::ostream* out) { *out << reader.name; }

std::vector<Reader> readers() {
  return {
      {"surface", "a.obj", [](const std::string& f) { formats::readSurface(f); }},
      {"tetrahedra", "a.vtu", [](const std::string& f) { formats::readTetMesh(f); }},
      {"trajectory", "a.csv", [](const std::string& f) { formats::readTrajectory(f); }},
      {"scene", "a.yaml", [](const std::string& f) { scene::readScene(f); }},
      {"case", "a.yaml", [](const std::string& f) { analysis::readCase(f); }},
      {"tissue", "a.yaml", [](const std::string& f) { scene::readTissueFile(f); }},
      {"instrument", "a.urdf", [](const std::string& f) { instrument::readInstrument(f); }},
      {"state", "a.state", [](const std::string& f) { io::readState(f); }},
      {"springs", "a.csv", [](const std::string& f) { springs::readSprings(f); }},
      {"surrogate", "a.net", [](const std::string& f) { enrichment::readSurrogate(f); }},
      {"database", "body.bin",
       [](const std::string& f) {
         enrichment::readDatabase(std::filesystem::path(f).parent_path().string());
       }},
  };
}

class HostilePath : public ::testing::TestWithParam<Reader> {
 protected:
  std::string path() const { return folder_.path(GetParam().file); }
  /// What is said of what stands there now; it takes next to no memory.
  std::string complaint(const std::string& file) const {
    const test::HeapPeak heap;
    const std::string text = test::complaint([&] { GetParam().read(file); });
    EXPECT_LT(heap.bytes(), std::size_t{1} << 20);
    return text;
  }
  std::string complaint() const { return complaint(path()); }
  void link(const std::string& to) const {
    std::filesystem::remove(path());
    std::filesystem::create_symlink(to, path());
  }
  test::TempFolder folder_;
};
INSTANTIATE_TEST_SUITE_P(Of, HostilePath, ::testing::ValuesIn(readers()),
                         [](const auto& of) { return of.param.name; });

TEST_P(HostilePath, PipesDevicesAndFoldersAreRefused) {
  ASSERT_EQ(::mkfifo(path().c_str(), 0600), 0);
  EXPECT_TRUE(test::contains(complaint(), "must be a regular file"));
  for (const char* device : {"/dev/zero", "/dev/urandom", "/dev/null"}) {
    link(device);
    EXPECT_TRUE(test::contains(complaint(), "must be a regular file")) << device;
  }
  link(folder_.path(""));
  EXPECT_TRUE(test::contains(complaint(), "is a folder"));
  link(path());
  EXPECT_TRUE(test::contains(complaint(), "cannot be opened"));
}

TEST_P(HostilePath, HolesOfATebibyteAreRefused) {
  folder_.write(GetParam().file, "");
  std::filesystem::resize_file(path(), std::uintmax_t{1} << 40);
  EXPECT_TRUE(test::contains(complaint(), "is larger than"));
}

TEST_P(HostilePath, NamesThatCannotBeAreRefused) {
  if (std::string(GetParam().name) == "database") return;  // which adds a name of its own
  for (const std::string& name :
       {std::string(), std::string(100000, 'x'), std::string(5000, '/'), std::string("a\0b", 3)}) {
    EXPECT_NE(complaint(name), "") << name.substr(0, 10);
  }
  EXPECT_TRUE(test::contains(complaint(folder_.path("absent/" + GetParam().file)), "no such file"));
}

TEST_P(HostilePath, FilesOfOthersAreRefused) {
  for (const char* other : {"/etc/passwd", "/proc/self/environ", "/proc/self/maps"}) {
    link(other);
    const std::string text = complaint();
    EXPECT_NE(text, "") << other;
    EXPECT_LT(text.size(), 10000U);
  }
}

}  // namespace
}  // namespace palpate
