// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/mesh_cache.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "mesh/surfaces.h"
#include "palpate/base/error.h"

namespace palpate::mesh::mesh_cache_test {
namespace {

namespace fs = std::filesystem;

class MeshCache : public ::testing::Test {
 protected:
  MeshCache() : directory_(fs::temp_directory_path() / unique()) {
    options_.edge_length.coarsest = 0.04;
    fresh_ = meshVolume(surface_, options_);
  }
  ~MeshCache() override {
    std::error_code error;
    fs::permissions(directory_, fs::perms::owner_all, error);
    fs::remove_all(directory_, error);
  }

  static std::string unique() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    return "palpate_mesh_cache_" + std::to_string(::getpid()) + "_" + test->name();
  }

  /// Asks the cache; the mesh must be right whether it hits or not.
  bool hits() {
    bool hit = false;
    const TetMesh mesh = meshVolumeCached(surface_, options_, directory_.string(), {}, &hit);
    EXPECT_EQ(mesh.points, fresh_.points);
    EXPECT_EQ(mesh.tets, fresh_.tets);
    return hit;
  }
  std::string file() const { return cacheFile(surface_, options_, directory_.string()); }

  fs::path directory_;
  SurfaceMesh surface_ = boxSurface(0.1, 1);
  MeshingOptions options_;
  TetMesh fresh_;
};

TEST_F(MeshCache, HitsTheSecondTime) {
  EXPECT_FALSE(hits());
  EXPECT_TRUE(fs::exists(file()));
  EXPECT_TRUE(hits());
  // Nothing else was left behind.
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()), 1);
}

TEST_F(MeshCache, MissesForAnotherSurfaceOrOtherSettings) {
  const std::string before = file();
  MeshingOptions other = options_;
  other.edge_length.coarsest = 0.04 + 1e-15;
  EXPECT_NE(cacheFile(surface_, other, directory_.string()), before);
  other = options_;
  other.sharp_edges = SharpEdges::kIgnore;
  EXPECT_NE(cacheFile(surface_, other, directory_.string()), before);
  SurfaceMesh moved_surface = surface_;
  moved_surface.points(0, 0) += 1e-15;
  EXPECT_NE(cacheFile(moved_surface, options_, directory_.string()), before);
  moved_surface = surface_;
  std::swap(moved_surface.triangles(0, 3), moved_surface.triangles(1, 3));
  EXPECT_NE(cacheFile(moved_surface, options_, directory_.string()), before);
  other = options_;
  other.file = "named otherwise.obj";
  EXPECT_EQ(cacheFile(surface_, other, directory_.string()), before);
}

TEST_F(MeshCache, MakesADamagedFileAnew) {
  hits();
  const auto size = fs::file_size(file());
  // A bit in each part of the file: magic, version, counts, checksum, points, tetrahedra.
  for (const std::uintmax_t at :
       {std::uintmax_t{0}, std::uintmax_t{8}, std::uintmax_t{16}, std::uintmax_t{24},
        std::uintmax_t{32}, std::uintmax_t{45}, size - 1}) {
    {
      std::fstream stream(file(), std::ios::in | std::ios::out | std::ios::binary);
      stream.seekg(static_cast<std::streamoff>(at));
      const char old = static_cast<char>(stream.get());
      stream.seekp(static_cast<std::streamoff>(at));
      stream.put(static_cast<char>(old ^ 0x10));
    }
    EXPECT_FALSE(hits()) << "byte " << at;
    EXPECT_TRUE(hits()) << "byte " << at;
  }
}

TEST_F(MeshCache, MakesATruncatedFileAnew) {
  hits();
  const auto size = fs::file_size(file());
  for (const std::uintmax_t length :
       {std::uintmax_t{0}, std::uintmax_t{10}, size / 2, size - 1, size + 100}) {
    fs::resize_file(file(), length);
    EXPECT_FALSE(hits()) << length;
    EXPECT_TRUE(hits()) << length;
  }
}

TEST_F(MeshCache, DoesNotBelieveHugeCounts) {
  hits();
  {
    std::fstream stream(file(), std::ios::in | std::ios::out | std::ios::binary);
    stream.seekp(16);
    const std::vector<char> ones(16, '\xff');
    stream.write(ones.data(), 16);
  }
  EXPECT_FALSE(hits());
}

TEST_F(MeshCache, WorksWithoutADirectory) {
  bool hit = true;
  EXPECT_EQ(meshVolumeCached(surface_, options_, "", {}, &hit).points, fresh_.points);
  EXPECT_FALSE(hit);
  // A file stands where the directory should be: that no user, root included, can write to.
  std::ofstream(directory_.string()) << "in the way";
  EXPECT_FALSE(hits());
  EXPECT_FALSE(hits());
}

TEST_F(MeshCache, IsSharedByManyAtOnce) {
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([this] {
      for (int k = 0; k < 5; ++k) hits();
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(hits());
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()), 1);
}

TEST_F(MeshCache, PassesErrorsOnAndKeepsNothing) {
  options_.edge_length.coarsest = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(meshVolumeCached(surface_, options_, directory_.string()), InputError);
  EXPECT_FALSE(fs::exists(directory_));
}

TEST(DefaultCacheDirectory, FollowsTheEnvironment) {
  const auto keep = [](const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? std::string() : std::string(value);
  };
  const std::string xdg = keep("XDG_CACHE_HOME"), home = keep("HOME");
  setenv("HOME", "/home/somebody", 1);
  setenv("XDG_CACHE_HOME", "/var/somewhere", 1);
  EXPECT_EQ(defaultCacheDirectory(), "/var/somewhere/palpate");
  setenv("XDG_CACHE_HOME", "relative/is/ignored", 1);
  EXPECT_EQ(defaultCacheDirectory(), "/home/somebody/.cache/palpate");
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(defaultCacheDirectory(), "/home/somebody/.cache/palpate");
  unsetenv("HOME");
  EXPECT_EQ(defaultCacheDirectory(), "");
  if (!xdg.empty()) setenv("XDG_CACHE_HOME", xdg.c_str(), 1);
  if (!home.empty()) setenv("HOME", home.c_str(), 1);
}

}  // namespace
}  // namespace palpate::mesh::mesh_cache_test
