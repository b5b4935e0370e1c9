// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/advice/mesh_verdict.h"

#include <gtest/gtest.h>

#include "palpate/fem/elasticity.h"
#include "palpate/formats/tet_io.h"
#include "palpate/formats/vtu_writer.h"
#include "palpate/tissue/fem/force_excess.h"
#include "sim/slab_scene.h"
#include "support/contains.h"

namespace palpate::advice::mesh_verdict_test {
namespace {

using test::contains;

// The block of docs/meshes.md: by edge over radius.
TEST(ForceExcess, IsWhatWasMeasured) {
  struct Measured {
    const char* element;
    double ratio, excess;
  };
  const std::vector<Measured> measured = {
      {"anp", 3.0, 1.391},   {"anp", 2.0, 0.719},   {"anp", 1.5, 0.643},    {"anp", 0.6, 0.176},
      {"anp", 0.4, 0.082},   {"anp", 0.28, 0.053},  {"tet4", 3.0, 2.461},   {"tet4", 0.6, 0.421},
      {"tet4", 0.4, 0.232},  {"p1p1", 2.0, 0.630},  {"p1p1", 0.4, 0.066},   {"tet10", 2.0, 0.377},
      {"tet10", 0.8, 0.097}, {"tet10", 0.6, 0.039}, {"tet10p", 2.0, 0.263}, {"tet10p", 0.8, 0.075},
      {"tet10p", 0.6, 0.033}};
  for (const Measured& m : measured) {
    SCOPED_TRACE(m.element + std::string(" ") + std::to_string(m.ratio));
    const std::optional<double> excess = tissue::forceExcess(m.element, m.ratio);
    ASSERT_TRUE(excess);
    const double factor = fem::isQuadratic(m.element) ? 1.7 : 1.35;
    EXPECT_GT(*excess, m.excess / factor);
    EXPECT_LT(*excess, m.excess * factor);
  }
}

TEST(ForceExcess, IsKnownForEveryElementAndHasAnInverse) {
  for (const std::string& element : fem::elementNames()) {
    SCOPED_TRACE(element);
    ASSERT_TRUE(tissue::edgeRatioFor(element, 0.08));
    EXPECT_NEAR(*tissue::forceExcess(element, *tissue::edgeRatioFor(element, 0.08)), 0.08, 1e-12);
    EXPECT_GT(*tissue::forceExcess(element, 1.1), *tissue::forceExcess(element, 1.0));
  }
  EXPECT_FALSE(tissue::forceExcess("hexahedra", 1.0));
  EXPECT_FALSE(tissue::edgeRatioFor("hexahedra", 1.0));
}

TEST(SurfaceEdges, AreThoseOfTheCornersOutside) {
  const mesh::TetMesh box = mesh::boxMesh(Vec3(0.1, 0.1, 0.1), Eigen::Vector3i::Constant(5));
  const SurfaceEdges edges = surfaceEdges(mesh::cellsOf(box));
  EXPECT_GT(edges.finest, 0.02);
  EXPECT_LT(edges.coarsest, 0.0283);
  EXPECT_NEAR(edges.mean, 0.0228, 3e-4);  // (20 + 20 + 28.3) / 3
  EXPECT_FALSE(edges.graded());
  EXPECT_DOUBLE_EQ(surfaceEdges(mesh::cellsOf(mesh::toQuadratic(box))).mean, edges.mean);
  mesh::CellMesh triangles{box.points, mesh::boundaryTriangles(box.tets), {}};
  EXPECT_DOUBLE_EQ(surfaceEdges(triangles).mean, edges.mean);
  triangles.cells = Eigen::MatrixXi(2, 0);
  EXPECT_EQ(surfaceEdges(triangles).mean, 0.0);
}

TEST(SurfaceEdges, KnowFineAndCoarseParts) {
  mesh::TetMesh box = mesh::boxMesh(Vec3(1, 1, 1), Eigen::Vector3i::Constant(10));
  box.points = box.points.array().cube();  // edges of 1 mm at the origin, of 271 mm opposite
  const SurfaceEdges edges = surfaceEdges(mesh::cellsOf(box));
  EXPECT_TRUE(edges.graded());
  EXPECT_LT(edges.finest, 0.2 * edges.mean);
  EXPECT_GT(edges.coarsest, edges.mean);
}

TEST(AdviceOnMeshes, NamesOrganToolAndRemedy) {
  const test::SlabScene slab;
  const sim::Simulator simulator(slab.scene());
  const std::vector<std::string> advice = adviseOnMeshes(simulator);
  ASSERT_EQ(advice.size(), 1u);
  for (const char* part :
       {"organ slab: edges of 18 mm against a ball of 5 mm (probe): the force will be about ",
        "0 % too large; 8 % with adapt: {finest: 0.00"}) {
    EXPECT_TRUE(contains(advice[0], part)) << advice[0];
  }
  const std::vector<std::string> notes = loadingNotes(simulator);
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes.back(), advice[0]);
}

// No mesh makes the force of a point right.
TEST(AdviceOnMeshes, KnowsThatAPointHasNoArea) {
  const test::SlabScene slab;
  scene::Scene scene = slab.scene();
  scene.contact.model = "prescribed";
  scene.solver.method = "newton_bicgstab";
  scene.instruments[0].urdf = test::sourceFolder() + "/config/instruments/stylus.urdf";
  const std::vector<std::string> advice = adviseOnMeshes(sim::Simulator(scene));
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_TRUE(contains(advice[0], "the force is that of edges of 18 mm")) << advice[0];
  EXPECT_FALSE(contains(advice[0], "adapt")) << advice[0];
}

TEST(AdviceOnMeshes, NamesTheSameRemedyForQuadraticElementsUnlessTheyAreBent) {
  const test::SlabScene slab;
  scene::Scene scene = slab.scene();
  scene.organs[0].element = "tet10";
  const std::vector<std::string> advice = adviseOnMeshes(sim::Simulator(scene));
  ASSERT_EQ(advice.size(), 1u);
  EXPECT_TRUE(contains(advice[0], "8 % with adapt: {finest: 0.0047}")) << advice[0];

  scene.organs[0].adapt.finest = 0.0047;
  EXPECT_TRUE(adviseOnMeshes(sim::Simulator(scene)).empty());
  scene.organs[0].adapt.finest = 0.0;
  mesh::TetMesh bent = mesh::toQuadratic(formats::readTetMesh(slab.folder().path("slab.vtu")));
  bent.points.col(bent.midnodes(0, 0)).array() += 1e-5;
  formats::writeVtu(slab.folder().path("slab.vtu"), bent, {}, {});
  const std::vector<std::string> other = adviseOnMeshes(sim::Simulator(scene));
  ASSERT_EQ(other.size(), 1u);
  EXPECT_TRUE(contains(other[0], "8 % with a mesh with edges of 0.0047 m there")) << other[0];
}

// A graded slab of its own, and the figure that is said of it.
class GradedSlab : public ::testing::Test {
 protected:
  static std::vector<std::string> adviceAt(double finest, const std::string& element) {
    const test::SlabScene slab;
    scene::Scene scene = slab.scene();
    scene::OrganConfig& organ = scene.organs[0];
    organ.tetrahedra.clear();
    organ.surface = test::sourceFolder() + "/config/organs/slab.obj";
    organ.element = element;
    organ.pose = {};
    scene::RefinementZoneConfig place;
    place.finest = finest;
    place.radius = 0.01;
    place.where = mesh::Polyline{{Vec3(0.0, 0.0, 0.03)}};
    organ.edge_length = {0.015, {place}};
    return adviseOnMeshes(sim::Simulator(scene));
  }
};

TEST_F(GradedSlab, IsJudgedByItsFinestPart) {
  EXPECT_TRUE(adviceAt(0.002, "anp").empty());
  const std::vector<std::string> coarse = adviceAt(0.0035, "anp");
  ASSERT_EQ(coarse.size(), 1u);
  EXPECT_TRUE(contains(coarse[0], "organ slab: where it is finest, edges of 3.")) << coarse[0];
  EXPECT_TRUE(contains(coarse[0], "adapt: {finest: 0.00")) << coarse[0];
  EXPECT_TRUE(adviceAt(0.0035, "tet10").empty());
  EXPECT_FALSE(adviceAt(0.002, "tet4").empty());
}

}  // namespace
}  // namespace palpate::advice::mesh_verdict_test
