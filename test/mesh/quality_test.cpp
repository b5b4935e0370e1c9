// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/quality.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/surfaces.h"
#include "palpate/mesh/edge_lengths.h"

namespace palpate::mesh::quality_test {
namespace {

TEST(Quality, OfARegularTetrahedron) {
  TetMesh mesh;
  mesh.points.resize(3, 4);
  mesh.points << 1, 1, -1, -1,  //
      1, -1, 1, -1,             //
      1, -1, -1, 1;
  mesh.tets = Eigen::Vector4i(0, 2, 1, 3);
  if (signedVolume(mesh.points, mesh.tets.col(0)) < 0) mesh.tets = Eigen::Vector4i(0, 1, 2, 3);
  const TetQuality quality = measureQuality(mesh);
  EXPECT_NEAR(quality.min_dihedral_deg, 70.528779365509308, 1e-12);
  EXPECT_NEAR(quality.median_dihedral_deg, 70.528779365509308, 1e-12);
  EXPECT_NEAR(quality.worst_radius_edge_ratio, std::sqrt(6.0) / 4.0, 1e-14);
  EXPECT_NEAR(quality.mean_edge_length, std::sqrt(8.0), 1e-14);
  EXPECT_NEAR(quality.volume, 8.0 / 3.0, 1e-14);
  EXPECT_EQ(quality.volume_error, 0.0);
}

TEST(Quality, OfAKuhnBox) {
  // All tetrahedra are alike: least angle 45 degrees, ball of the cube's diagonal by its side.
  const TetMesh mesh = boxMesh(Vec3::Constant(0.2), {2, 2, 2});
  const TetQuality quality = measureQuality(mesh);
  EXPECT_NEAR(quality.min_dihedral_deg, 45.0, 1e-9);
  EXPECT_NEAR(quality.worst_radius_edge_ratio, std::sqrt(3.0) / 2.0, 1e-12);
  EXPECT_NEAR(quality.volume, 8e-3, 1e-15);
}

TEST(Quality, VolumeErrorIsRelativeToTheReference) {
  const TetMesh mesh = boxMesh(Vec3::Constant(0.1), {1, 1, 1});
  const SurfaceMesh larger = boxSurface(0.2, 1);
  EXPECT_NEAR(measureQuality(mesh, &larger).volume_error, -7.0 / 8.0, 1e-12);
}

TEST(Quality, SeesTheWorstOfMany) {
  TetMesh mesh = boxMesh(Vec3::Constant(0.2), {2, 2, 2});
  mesh.points(2, 26) -= 0.09;  // a corner of the box nearly down to the next layer
  const TetQuality quality = measureQuality(mesh);
  EXPECT_LT(quality.min_dihedral_deg, 10.0);
  EXPECT_NEAR(quality.median_dihedral_deg, 45.0, 1e-9);
}

TEST(EdgeLengths, OfAHexahedronAreItsTwelveEdges) {
  CellMesh box;
  box.points.resize(3, 8);
  for (int k = 0; k < 8; ++k) {
    box.points.col(k) << 0.01 * (k & 1), 0.02 * (k >> 1 & 1), 0.04 * (k >> 2);
  }
  box.cells.resize(8, 1);
  box.cells << 0, 1, 3, 2, 4, 5, 7, 6;
  EXPECT_EQ(edgesOf(box).size(), 12u);
  EXPECT_DOUBLE_EQ(meanEdgeLength(box), 0.07 / 3.0);
}

TEST(EdgeLengths, OfAKuhnBox) {
  // Cells of 12 mm: 12 edges of the cube, 6 diagonals of faces of 17 mm, one of the cube of 21 mm.
  const EdgeLengths edges = measureEdges(cellsOf(boxMesh(Vec3::Constant(0.012), {1, 1, 1})));
  EXPECT_DOUBLE_EQ(edges.least, 0.012);
  EXPECT_DOUBLE_EQ(edges.largest, 0.012 * std::sqrt(3.0));
  EXPECT_NEAR(edges.mean, 0.012 * (12 + 6 * std::sqrt(2.0) + std::sqrt(3.0)) / 19, 1e-15);
  EXPECT_EQ(edges.mean, meanEdgeLength(cellsOf(boxMesh(Vec3::Constant(0.012), {1, 1, 1}))));
  ASSERT_EQ(edges.classes.size(), 3u);
  const double bounds[] = {0.01, 0.015, 0.02, 0.03};
  const int counts[] = {12, 6, 1};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(edges.classes[k].from, bounds[k]);
    EXPECT_EQ(edges.classes[k].to, bounds[k + 1]);
    EXPECT_EQ(edges.classes[k].edges, counts[k]);
  }
}

TEST(EdgeLengths, ABoundBelongsToTheClassAboveAndEmptyClassesAreShown) {
  CellMesh lines;
  lines.points.resize(3, 4);
  lines.points << 0, 0.002, 0, 0, 0, 0, 0.007, 0.007, 0, 0, 0, 0;
  lines.cells.resize(2, 2);
  lines.cells << 0, 0, 1, 2;
  const EdgeLengths edges = measureEdges(lines);
  ASSERT_EQ(edges.classes.size(), 4u);  // 2, 3, 5, 7
  EXPECT_EQ(edges.classes[0].from, 0.002);
  EXPECT_EQ(edges.classes[0].edges, 1);
  EXPECT_EQ(edges.classes[1].edges, 0);
  EXPECT_EQ(edges.classes[2].edges, 0);
  EXPECT_EQ(edges.classes[3].to, 0.01);
  EXPECT_EQ(edges.classes[3].edges, 1);
  EXPECT_TRUE(measureEdges(CellMesh()).classes.empty());
}

TEST(Quality, OfFlatAndOfNoTetrahedra) {
  TetMesh mesh = boxMesh(Vec3::Constant(0.1), {1, 1, 1});
  mesh.points.row(2).setZero();
  EXPECT_TRUE(std::isinf(measureQuality(mesh).worst_radius_edge_ratio));
  EXPECT_EQ(measureQuality(mesh).min_dihedral_deg, 0.0);
  EXPECT_EQ(measureQuality(TetMesh()).volume, 0.0);
}

}  // namespace
}  // namespace palpate::mesh::quality_test
