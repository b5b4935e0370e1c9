// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/volume_mesher.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "mesh/surfaces.h"
#include "palpate/base/error.h"
#include "palpate/mesh/quality.h"
#include "palpate/mesh/selection.h"
#include "palpate/mesh/surface_check.h"
#include "palpate/organs/organs.h"

namespace palpate::mesh::volume_mesher_test {
namespace {

MeshingOptions withEdge(double edge_length) {
  MeshingOptions options;
  options.edge_length.coarsest = edge_length;
  options.file = "organ.obj";
  return options;
}

void expectSound(const SurfaceMesh& surface, double edge_length, int components = 1) {
  const TetMesh mesh = meshVolume(surface, withEdge(edge_length));
  const TetQuality quality = measureQuality(mesh, &surface);
  EXPECT_GE(quality.min_dihedral_deg, 10.0);
  EXPECT_GE(quality.median_dihedral_deg, 42.0);
  EXPECT_LE(quality.worst_radius_edge_ratio, 4.0);
  EXPECT_NEAR(quality.mean_edge_length, edge_length, 0.1 * edge_length);
  EXPECT_LT(std::abs(quality.volume_error), 0.02);
  const double guess = estimateTets(enclosedVolume(surface), edge_length);
  EXPECT_NEAR(static_cast<double>(mesh.numTets()), guess, 0.25 * guess);

  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    ASSERT_GT(signedVolume(mesh.points, mesh.tets.col(t)), 0.0);
  }
  std::vector<bool> used(mesh.numPoints(), false);
  for (Eigen::Index c = 0; c < mesh.tets.size(); ++c) used[mesh.tets(c % 4, c / 4)] = true;
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);

  SurfaceMesh boundary{mesh.points, boundaryTriangles(mesh.tets)};
  const SurfaceReport report = checkSurface(boundary);
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.components, components);
}

TEST(VolumeMesher, FillsTheLiver) { expectSound(organs::makeOrgan("liver", 0.006), 0.0155); }
TEST(VolumeMesher, FillsTheLiverFinely) { expectSound(organs::makeOrgan("liver", 0.006), 0.009); }
TEST(VolumeMesher, FillsTheKidney) { expectSound(organs::makeOrgan("kidney", 0.004), 0.007); }
TEST(VolumeMesher, FillsTheGallbladder) {
  expectSound(organs::makeOrgan("gallbladder", 0.003), 0.005);
}
TEST(VolumeMesher, FillsTheSlab) { expectSound(organs::makeOrgan("slab", 0.010), 0.010); }
TEST(VolumeMesher, FillsACoarseBox) { expectSound(boxSurface(0.1, 1), 0.012); }

TEST(VolumeMesher, LeavesACavityEmpty) {
  SurfaceMesh cavity = moved(boxSurface(0.04, 1), Vec3::Constant(0.03));
  flipAll(&cavity);
  expectSound(joined(boxSurface(0.1, 1), cavity), 0.010, 2);
}

TEST(VolumeMesher, FillsSeparateBodies) {
  expectSound(joined(boxSurface(0.1, 1), moved(boxSurface(0.04, 1), Vec3::Constant(0.12))), 0.010,
              2);
}

TEST(VolumeMesher, FindsASmallRoundBodyAside) {
  const SurfaceMesh kidney = organs::makeOrgan("kidney", 0.005);
  SurfaceMesh pebble = organs::makeOrgan("kidney", 0.005);
  pebble.points *= 0.3;
  expectSound(joined(kidney, moved(pebble, Vec3(0.2, 0.3, 0.1))), 0.007, 2);
}

TEST(VolumeMesher, AssignsCavitiesToTheirBodies) {
  // A box in the cavity of a box, itself with a cavity, and another box aside.
  SurfaceMesh outer_cavity = moved(boxSurface(0.08, 1), Vec3::Constant(0.01));
  SurfaceMesh inner_cavity = moved(boxSurface(0.02, 1), Vec3::Constant(0.04));
  flipAll(&outer_cavity);
  flipAll(&inner_cavity);
  const SurfaceMesh inner = moved(boxSurface(0.05, 1), Vec3::Constant(0.025));
  const SurfaceMesh aside = moved(boxSurface(0.03, 1), Vec3::Constant(0.2));
  const SurfaceMesh all =
      joined(joined(joined(inner_cavity, boxSurface(0.1, 1)), outer_cavity), joined(inner, aside));
  const TetMesh mesh = meshVolume(all, withEdge(0.006));
  EXPECT_NEAR(measureQuality(mesh).volume, 1e-3 - 0.512e-3 + 0.125e-3 - 8e-6 + 27e-6, 1e-9);
}

TEST(VolumeMesher, KeepsTheEdgesOfASlab) {
  const SurfaceMesh slab = organs::makeOrgan("slab", 0.01);
  const TetMesh mesh = meshVolume(slab, withEdge(0.01));
  EXPECT_NEAR(measureQuality(mesh, &slab).volume_error, 0.0, 1e-6);
  // All of its eight corners, exactly.
  for (const double x : {-0.05, 0.05}) {
    for (const double y : {-0.05, 0.05}) {
      for (const double z : {0.0, 0.03}) {
        EXPECT_EQ(selectPoints(mesh.points, SphereRegion{Vec3(x, y, z), 1e-9}).size(), 1U);
      }
    }
  }
  // Enough of them in each plane to hold it by.
  EXPECT_GT(selectPoints(mesh.points, PlaneRegion{2, 0.0, 1e-9}).size(), 100U);

  MeshingOptions blunt = withEdge(0.01);
  blunt.sharp_edges = SharpEdges::kIgnore;
  EXPECT_LT(measureQuality(meshVolume(slab, blunt), &slab).volume_error, -1e-4);
}

TEST(VolumeMesher, GivesTheSameBitsEachTime) {
  const SurfaceMesh liver = organs::makeOrgan("liver", 0.008);
  const TetMesh a = meshVolume(liver, withEdge(0.016));
  meshVolume(organs::makeOrgan("slab", 0.02), withEdge(0.02));  // something else between
  const TetMesh b = meshVolume(liver, withEdge(0.016), [](const std::string&, double) {});
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.tets, b.tets);
}

TEST(VolumeMesher, ReportsGrowingProgress) {
  std::vector<double> fractions;
  std::vector<std::string> stages;
  meshVolume(organs::makeOrgan("liver", 0.008), withEdge(0.012),
             [&](const std::string& stage, double f) {
               fractions.push_back(f);
               if (stages.empty() || stages.back() != stage) stages.push_back(stage);
             });
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.front(), 0.0);
  EXPECT_EQ(fractions.back(), 1.0);
  EXPECT_GT(fractions.size(), 30U);
  EXPECT_EQ(stages, (std::vector<std::string>{"reading the surface", "refining",
                                              "perturbing slivers", "exuding slivers", "done"}));
}

std::string refusal(const SurfaceMesh& surface, double edge_length) {
  try {
    meshVolume(surface, withEdge(edge_length));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(VolumeMesher, RefusesAnEdgeLengthThatIsNone) {
  const SurfaceMesh box = boxSurface(0.1, 1);
  for (const double length : {0.0, -0.01, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
    const std::string text = refusal(box, length);
    EXPECT_TRUE(says(text, "organ.obj: edge_length = ")) << text;
    EXPECT_TRUE(says(text, "positive number")) << text;
  }
}

TEST(VolumeMesher, RefusesTooLargeAnEdgeLength) {
  const std::string text = refusal(boxSurface(0.1, 1), 0.2);
  EXPECT_TRUE(says(text, "too large")) << text;
  EXPECT_TRUE(says(text, "0.05 m")) << text;
}

TEST(VolumeMesher, RefusesTooSmallAnEdgeLengthWithTheNumber) {
  const SurfaceMesh box = boxSurface(0.1, 1);
  const std::string text = refusal(box, 1e-4);
  EXPECT_TRUE(says(text, "too small")) << text;
  EXPECT_TRUE(says(text, "1.05263e+10 tetrahedra")) << text;
  EXPECT_TRUE(says(text, "at least 0.00173946 m")) << text;
  EXPECT_EQ(refusal(boxSurface(0.1, 1), 0.05), "");
}

TEST(VolumeMesher, RefusesASurfaceInsideOut) {
  SurfaceMesh box = boxSurface(0.1, 1);
  flipAll(&box);
  EXPECT_TRUE(says(refusal(box, 0.02), "face outward"));
}

}  // namespace
}  // namespace palpate::mesh::volume_mesher_test
