// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/distance_grid_cache.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "support/concave_surfaces.h"
#include "support/temp_folder.h"

namespace palpate::mesh::distance_grid_cache_test {
namespace {

class DistanceGridCache : public ::testing::Test {
 protected:
  DistanceGridCache() {
    settings.cells = 16;
    settings.error = 1e-2;
    fresh = makeDistanceGrid(surface, settings);
  }

  /// Asks the cache; the grid must be right whether it hits or not.
  bool hits() const {
    bool hit = false;
    const DistanceGrid grid = distanceGridCached(surface, settings, directory(), {}, &hit);
    EXPECT_EQ(grid.field.coefficients, fresh.field.coefficients);
    EXPECT_EQ(grid.field.box.cells, fresh.field.box.cells);
    EXPECT_EQ(grid.field.box.low, fresh.field.box.low);
    EXPECT_EQ(grid.field.box.spacing, fresh.field.box.spacing);
    EXPECT_EQ(grid.surface.points, fresh.surface.points);
    EXPECT_EQ(grid.surface.triangles, fresh.surface.triangles);
    EXPECT_EQ(grid.largest_error, fresh.largest_error);
    EXPECT_EQ(grid.rms_error, fresh.rms_error);
    EXPECT_EQ(grid.limited, fresh.limited);
    EXPECT_EQ(grid.deepest, fresh.deepest);
    EXPECT_EQ(grid.inscribed_radius, fresh.inscribed_radius);
    return hit;
  }
  std::string directory() const { return folder.path("cache"); }
  std::string file() const { return cacheFile(surface, settings, directory()); }

  test::TempFolder folder;
  SurfaceMesh surface = test::uSurface();
  DistanceGridSettings settings;
  DistanceGrid fresh;
};

TEST_F(DistanceGridCache, HitsTheSecondTime) {
  EXPECT_FALSE(hits());
  EXPECT_TRUE(std::filesystem::exists(file()));
  EXPECT_TRUE(hits());
}

TEST_F(DistanceGridCache, MissesForAnotherSurfaceOrOtherSettings) {
  DistanceGridSettings other = settings;
  other.cells = 17;
  EXPECT_NE(cacheFile(surface, other, directory()), file());
  other = settings;
  other.error *= 2.0;
  EXPECT_NE(cacheFile(surface, other, directory()), file());
  other = settings;
  other.memory *= 2.0;
  EXPECT_NE(cacheFile(surface, other, directory()), file());
  other = settings;
  other.margin = 0.001;
  EXPECT_NE(cacheFile(surface, other, directory()), file());
  SurfaceMesh moved = surface;
  moved.points(0, 0) += 1e-15;
  EXPECT_NE(cacheFile(moved, settings, directory()), file());
}

TEST_F(DistanceGridCache, MakesADamagedFileAnew) {
  EXPECT_FALSE(hits());
  const auto size = static_cast<long>(std::filesystem::file_size(file()));
  for (const long at : {0L, 10L, 20L, 40L, 60L, 100L, 150L, size / 2, size - 1}) {
    std::fstream damaged(file(), std::ios::binary | std::ios::in | std::ios::out);
    damaged.seekg(at);
    const int byte = damaged.get();
    damaged.seekp(at);
    damaged.put(static_cast<char>(byte ^ 0x10));
    damaged.close();
    EXPECT_FALSE(hits()) << "at " << at;
    EXPECT_TRUE(hits());
  }
  std::filesystem::resize_file(file(), static_cast<std::uintmax_t>(size - 8));
  EXPECT_FALSE(hits());
  EXPECT_TRUE(hits());
}

TEST_F(DistanceGridCache, IsNotNeeded) {
  bool hit = true;
  EXPECT_EQ(distanceGridCached(surface, settings, "", {}, &hit).field.coefficients,
            fresh.field.coefficients);
  EXPECT_FALSE(hit);
}

}  // namespace
}  // namespace palpate::mesh::distance_grid_cache_test
