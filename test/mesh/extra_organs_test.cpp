// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "palpate/base/error.h"
#include "palpate/formats/surface_io.h"
#include "palpate/mesh/quality.h"
#include "palpate/mesh/size_check.h"
#include "palpate/mesh/surface_check.h"
#include "palpate/mesh/volume_mesher.h"

namespace palpate::mesh::extra_organs_test {
namespace {

TEST(ExtraOrgans, ALiverWithAFoldIsMendedAndMeshed) {
  const char* folder = std::getenv("PALPATE_EXTRA_DATA");
  if (!folder || !*folder)
    GTEST_SKIP() << "needs meshes that are not shipped: a folder in PALPATE_EXTRA_DATA";
  const std::string file = std::string(folder) + "/organs/liver-smooth.obj";
  SurfaceMesh surface = formats::readSurface(file);
  EXPECT_THROW(checkSize(surface.points, file, "scale"), InputError);
  surface.points *= 0.04;
  EXPECT_NO_THROW(checkSize(surface.points, file, "scale"));

  ASSERT_GT(checkSurface(surface).self_intersecting_triangles, 0);
  SurfaceReport report;
  const SurfaceMesh mended = repairSurface(surface, file, &report);
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.repairs.size(), 1U);
  EXPECT_NEAR(enclosedVolume(mended), enclosedVolume(surface), 0.01 * enclosedVolume(surface));

  MeshingOptions options;
  options.edge_length.coarsest = 0.016;
  const TetQuality quality = measureQuality(meshVolume(mended, options), &mended);
  EXPECT_GE(quality.min_dihedral_deg, 8.0);
  EXPECT_LT(std::abs(quality.volume_error), 0.02);
}

}  // namespace
}  // namespace palpate::mesh::extra_organs_test
