// SPDX-License-Identifier: GPL-3.0-or-later
// Files that others wrote, from the folder that PALPATE_EXTRA_DATA names.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "palpate/formats/surface_io.h"
#include "palpate/formats/tet_io.h"
#include "palpate/formats/vtu_writer.h"
#include "support/temp_folder.h"

namespace palpate::formats::mesh_extra_data_test {
namespace {

class ExtraData : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("PALPATE_EXTRA_DATA");
    if (!folder || !*folder)
      GTEST_SKIP() << "needs meshes that are not shipped: a folder in PALPATE_EXTRA_DATA";
    folder_ = folder;
    if (!std::filesystem::is_directory(folder_))
      GTEST_SKIP() << "needs meshes that are not shipped: PALPATE_EXTRA_DATA = " << folder_
                   << " is no folder";
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::filesystem::path folder_;
};

TEST_F(ExtraData, TetrahedraOfGmsh1) {
  struct {
    const char* name;
    int points, tets;
  } const files[] = {{"organs/liver.msh", 181, 596},
                     {"organs/liver2.msh", 507, 1493},
                     {"organs/truthcylinder1.msh", 642, 2524}};
  const test::TempFolder dir;
  for (const auto& f : files) {
    const mesh::TetMesh mesh = readTetMesh(file(f.name));
    EXPECT_EQ(mesh.numPoints(), f.points) << f.name;
    EXPECT_EQ(mesh.numTets(), f.tets) << f.name;
    EXPECT_EQ(static_cast<int>(mesh.region.size()), f.tets) << f.name;
    writeVtu(dir.path("a.vtu"), mesh, {}, {});
    const mesh::TetMesh back = readTetMesh(dir.path("a.vtu"));
    EXPECT_EQ(back.points, mesh.points) << f.name;
    EXPECT_EQ(back.tets, mesh.tets) << f.name;
  }
}

TEST_F(ExtraData, VolumeOfTheLiverIsThatOfItsBoundary) {
  const mesh::TetMesh mesh = readTetMesh(file("organs/liver.msh"));
  double volume = 0.0;
  for (Eigen::Index i = 0; i < mesh.numTets(); ++i) {
    volume += mesh::signedVolume(mesh.points, mesh.tets.col(i));
  }
  const mesh::SurfaceMesh boundary{mesh.points, mesh::boundaryTriangles(mesh.tets)};
  EXPECT_NEAR(mesh::enclosedVolume(boundary), volume, 1e-12 * volume);
  EXPECT_NEAR(mesh::enclosedVolume(readSurface(file("organs/liver.obj"))), volume, 1e-3 * volume);
}

TEST_F(ExtraData, SurfaceOfTheLiver) {
  const mesh::SurfaceMesh surface = readSurface(file("organs/liver-smooth.obj"));
  EXPECT_EQ(surface.points.cols(), 2194);
  EXPECT_EQ(surface.triangles.cols(), 4384);
  EXPECT_GT(mesh::enclosedVolume(surface), 0.0);
}

TEST_F(ExtraData, MeshesOfTheInstrument) {
  int read = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "instruments")) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".STL" && extension != ".obj") continue;
    const mesh::SurfaceMesh surface = readSurface(entry.path().string());
    EXPECT_GT(surface.triangles.cols(), 50) << entry.path();
    // Merged: a closed surface has about half as many points as triangles.
    EXPECT_LT(surface.points.cols(), 0.6 * static_cast<double>(surface.triangles.cols()))
        << entry.path();
    ++read;
  }
  EXPECT_EQ(read, 15);
}

}  // namespace
}  // namespace palpate::formats::mesh_extra_data_test
