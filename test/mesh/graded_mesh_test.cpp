// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh/surfaces.h"
#include "palpate/base/error.h"
#include "palpate/mesh/mesh_cache.h"
#include "palpate/mesh/quality.h"
#include "palpate/mesh/surface_check.h"
#include "palpate/mesh/volume_mesher.h"
#include "palpate/organs/organs.h"
#include "support/contains.h"

namespace palpate::mesh::graded_mesh_test {
namespace {

using test::contains;

RefinementZone nearPoint(const Vec3& point, double finest, double radius, double growth = 0.3) {
  RefinementZone place;
  place.finest = finest;
  place.radius = radius;
  place.growth = growth;
  place.where = Polyline{{point}};
  return place;
}

MeshingOptions graded(double coarsest, std::vector<RefinementZone> near) {
  MeshingOptions options;
  options.edge_length = {coarsest, std::move(near)};
  options.file = "organ.obj";
  return options;
}

/// Mean over the edges, each once, whose middle is where `wanted` says, of their length by the size
/// that is asked for there.
template <class Wanted>
double meanOfEdges(const TetMesh& mesh, const BodySizes& sizes, Wanted&& wanted) {
  std::set<std::pair<int, int>> edges;
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    for (int a = 0; a < 4; ++a) {
      for (int b = a + 1; b < 4; ++b) edges.insert(std::minmax({mesh.tets(a, t), mesh.tets(b, t)}));
    }
  }
  double sum = 0.0;
  int count = 0;
  for (const auto& [i, j] : edges) {
    const Vec3 p = mesh.points.col(i), q = mesh.points.col(j);
    if (!wanted(0.5 * (p + q))) continue;
    sum += (p - q).norm() / sizes.at(0.5 * (p + q));
    ++count;
  }
  EXPECT_GT(count, 100);
  return sum / count;
}

/// As good as a uniform mesh has to be, and of the sizes that were asked for: in the whole, and
/// within `distance` of `point`.
void expectSound(const SurfaceMesh& surface, const MeshingOptions& options, const Vec3& point,
                 double distance) {
  const TetMesh mesh = meshVolume(surface, options);
  const TetQuality quality = measureQuality(mesh, &surface);
  EXPECT_GE(quality.min_dihedral_deg, 10.0);
  EXPECT_GE(quality.median_dihedral_deg, 42.0);
  EXPECT_LE(quality.worst_radius_edge_ratio, 4.0);
  EXPECT_LT(std::abs(quality.volume_error), 0.02);
  EXPECT_TRUE(checkSurface({mesh.points, boundaryTriangles(mesh.tets)}).ok());

  const BodySizes sizes(options.edge_length, SurfaceDistance(surface));
  const auto near = [&](const Vec3& p) { return (p - point).norm() < distance; };
  EXPECT_NEAR(meanOfEdges(mesh, sizes, near), 1.0, 0.1);
  EXPECT_NEAR(meanOfEdges(mesh, sizes, [](const Vec3&) { return true; }), 1.0, 0.1);
  const double guess = estimateTets(surface, options.edge_length, kMaxTets).tets;
  EXPECT_NEAR(static_cast<double>(mesh.numTets()), guess, 0.15 * guess);
}

TEST(GradedMesh, IsFineNearAPointOfABox) {
  const Vec3 top(0.05, 0.05, 0.1);
  for (const double finest : {0.003, 0.0014}) {
    SCOPED_TRACE(finest);
    expectSound(boxSurface(0.1, 1), graded(0.015, {nearPoint(top, finest, 0.008)}), top, 0.008);
  }
}

TEST(GradedMesh, IsFineNearAnEdgeThatIsKept) {
  const Vec3 edge(0.05, 0.0, 0.1);
  expectSound(boxSurface(0.1, 1), graded(0.015, {nearPoint(edge, 0.003, 0.01)}), edge, 0.01);
}

TEST(GradedMesh, IsFineNearAPointOfTheLiver) {
  const SurfaceMesh liver = organs::makeOrgan("liver", 0.006);
  Eigen::Index highest = 0;
  liver.points.row(2).maxCoeff(&highest);
  const Vec3 top = liver.points.col(highest);
  expectSound(liver, graded(0.0155, {nearPoint(top, 0.003, 0.01)}), top, 0.01);
}

TEST(GradedMesh, IsFineAlongAPathAndInARegion) {
  RefinementZone path;
  path.finest = 0.004;
  path.radius = 0.005;
  path.where = Polyline{{Vec3(0.02, 0.02, 0.1), Vec3(0.08, 0.02, 0.1), Vec3(0.08, 0.08, 0.1)}};
  RefinementZone ball = path;
  ball.where = SphereRegion{Vec3(0.03, 0.07, 0.03), 0.01};
  const MeshingOptions options = graded(0.015, {path, ball});
  expectSound(boxSurface(0.1, 1), options, Vec3(0.08, 0.02, 0.1), 0.008);
  expectSound(boxSurface(0.1, 1), options, Vec3(0.03, 0.07, 0.03), 0.014);
}

TEST(GradedMesh, IsFineAtTheSurface) {
  RefinementZone skin;
  skin.finest = 0.006;
  skin.growth = 0.6;
  skin.where = OwnSurface{};
  const MeshingOptions options = graded(0.025, {skin});
  const SurfaceMesh box = boxSurface(0.1, 1);
  const TetMesh mesh = meshVolume(box, options);
  const BodySizes sizes(options.edge_length, SurfaceDistance(box));
  const SurfaceDistance depth(box);
  EXPECT_NEAR(meanOfEdges(mesh, sizes, [&](const Vec3& p) { return depth(p) < 0.004; }), 1.0, 0.1);
  EXPECT_NEAR(meanOfEdges(mesh, sizes, [&](const Vec3& p) { return depth(p) > 0.025; }), 1.0, 0.15);
}

TEST(GradedMesh, APlaceAsCoarseAsTheRestChangesNothingMuch) {
  const SurfaceMesh slab = organs::makeOrgan("slab", 0.01);
  const TetMesh same = meshVolume(slab, graded(0.01, {}));
  const TetMesh other = meshVolume(slab, graded(0.01, {nearPoint(Vec3::Zero(), 0.0099, 0.01)}));
  EXPECT_NEAR(static_cast<double>(other.numTets()), static_cast<double>(same.numTets()),
              0.15 * static_cast<double>(same.numTets()));
}

TEST(GradedMesh, GivesTheSameBitsEachTime) {
  const SurfaceMesh box = boxSurface(0.1, 1);
  const MeshingOptions options = graded(0.02, {nearPoint(Vec3(0.05, 0.05, 0.1), 0.004, 0.0)});
  const TetMesh a = meshVolume(box, options);
  meshVolume(box, graded(0.03, {}));
  std::vector<double> fractions;
  const TetMesh b =
      meshVolume(box, options, [&](const std::string&, double f) { fractions.push_back(f); });
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_GT(fractions.size(), 30U);
  EXPECT_EQ(fractions.back(), 1.0);
}

TEST(GradedMesh, IsRememberedByItsWholeField) {
  const SurfaceMesh box = boxSurface(0.1, 1);
  const MeshingOptions one = graded(0.02, {nearPoint(Vec3(0.05, 0.05, 0.1), 0.004, 0.01)});
  std::set<std::string> files = {cacheFile(box, graded(0.02, {}), "d"), cacheFile(box, one, "d")};
  std::size_t count = 2;
  const auto expectNew = [&](auto&& change) {
    MeshingOptions other = one;
    change(other.edge_length.near[0]);
    EXPECT_TRUE(files.insert(cacheFile(box, other, "d")).second) << count;
    EXPECT_EQ(files.size(), ++count);
  };
  expectNew([](RefinementZone& p) { p.finest += 1e-15; });
  expectNew([](RefinementZone& p) { p.growth += 1e-15; });
  expectNew([](RefinementZone& p) { p.radius += 1e-15; });
  expectNew([](RefinementZone& p) { p.where = Polyline{{Vec3(0.05, 0.05, 0.1 + 1e-15)}}; });
  expectNew([](RefinementZone& p) { p.where = Polyline{{Vec3::Zero(), Vec3(0.05, 0.05, 0.1)}}; });
  expectNew([](RefinementZone& p) { p.where = OwnSurface{}; });
  expectNew([](RefinementZone& p) { p.where = PlaneRegion{0, 0.1, 0.0}; });
  expectNew([](RefinementZone& p) { p.where = PlaneRegion{1, 0.1, 0.0}; });
  expectNew([](RefinementZone& p) { p.where = PlaneRegion{0, 0.1, 1e-9}; });
  expectNew([](RefinementZone& p) { p.where = SphereRegion{Vec3::Zero(), 0.1}; });
  expectNew([](RefinementZone& p) { p.where = SphereRegion{Vec3::Zero(), 0.2}; });
  expectNew([](RefinementZone& p) { p.where = BoxRegion{Vec3::Zero(), Vec3::Ones()}; });
  expectNew([](RefinementZone& p) { p.where = BoxRegion{Vec3::Zero(), Vec3(1, 1, 2)}; });
}

std::string refusal(const MeshingOptions& options) {
  try {
    meshVolume(boxSurface(0.1, 1), options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(GradedMesh, RefusesPlacesThatAreNone) {
  const Vec3 top(0.05, 0.05, 0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [&](double finest, double radius, double growth) {
    return refusal(
        graded(0.02, {nearPoint(top, 0.01, 0.0), nearPoint(top, finest, radius, growth)}));
  };
  for (const double wrong : {0.0, -1.0, nan}) {
    EXPECT_TRUE(contains(with(wrong, 0.0, 0.3), "edge_length.near[1].finest")) << wrong;
    EXPECT_TRUE(contains(with(0.01, 0.0, wrong), "edge_length.near[1].growth")) << wrong;
  }
  EXPECT_TRUE(contains(with(0.01, -1.0, 0.3), "edge_length.near[1].radius"));
  EXPECT_TRUE(contains(with(0.01, nan, 0.3), "edge_length.near[1].radius"));
  EXPECT_TRUE(contains(with(0.01, 0.0, 1.5), "must be in (0, 1]"));
  EXPECT_TRUE(
      contains(refusal(graded(-0.02, {nearPoint(top, 0.01, 0.0)})), "edge_length.coarsest"));
  RefinementZone nowhere = nearPoint(top, 0.01, 0.0);
  nowhere.where = Polyline{};
  EXPECT_TRUE(contains(refusal(graded(0.02, {nowhere})), "must have a point"));
}

TEST(GradedMesh, RefusesAPlaceThatTheBodyDoesNotFeel) {
  const std::string text = refusal(graded(0.02, {nearPoint(Vec3(0.05, 0.05, 0.1), 0.005, 0.0),
                                                 nearPoint(Vec3(50.0, 50.0, 100.0), 0.005, 0.01)}));
  EXPECT_TRUE(contains(text, "organ.obj: edge_length.near[1]: makes nothing in the body finer"))
      << text;
  EXPECT_TRUE(contains(text, "from [0, 0, 0] to [0.1, 0.1, 0.1] m in its own frame")) << text;
  // A point above the surface, as of a tool that has not touched yet, is felt.
  EXPECT_EQ(refusal(graded(0.02, {nearPoint(Vec3(0.05, 0.05, 0.11), 0.01, 0.0)})), "");
}

TEST(GradedMesh, RefusesTooManyTetrahedraByThePlaceThatMakesThem) {
  const Vec3 top(0.05, 0.05, 0.1);
  const std::string text =
      refusal(graded(0.02, {nearPoint(top, 0.01, 0.0), nearPoint(top, 2e-4, 0.02)}));
  EXPECT_TRUE(contains(text, "edge_length.near[1].finest = 0.0002: is too small")) << text;
  EXPECT_TRUE(contains(text, "tetrahedra, more than 2e+06; raise it, lower radius (0.02 m)"))
      << text;
  const std::string coarse = refusal(graded(2e-4, {nearPoint(top, 1e-4, 0.0)}));
  EXPECT_TRUE(contains(coarse, "edge_length.coarsest = 0.0002: is too small")) << coarse;
}

}  // namespace
}  // namespace palpate::mesh::graded_mesh_test
