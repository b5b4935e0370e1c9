// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/composition.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/input_error.h"
#include "support/random.h"
#include "support/temp_folder.h"

namespace palpate::scene::composition_test {
namespace {

using test::hasProblem;

MaterialConfig neoHookean(double mu) {
  MaterialConfig material;
  material.law = "neo_hookean";
  material.constants = {{"mu", {mu}}, {"kappa", {10.0 * mu}}};
  return material;
}

MaterialConfig guccione() {
  MaterialConfig material;
  material.law = "guccione";
  material.constants = material::exampleConstants("guccione");
  return material;
}

RegionConfig region(const std::string& name, const mesh::TetRegion& select,
                    const MaterialConfig& material) {
  RegionConfig region;
  region.name = name;
  region.select = select;
  region.material = material;
  return region;
}

mesh::TetRegion below(double z) { return mesh::BoxRegion{Vec3(-9, -9, -9), Vec3(9, 9, z)}; }

// A bar [0, 1] x [0, 1] x [0, 4] of four cells along z, six tetrahedra each, in order of z.
class Composition : public ::testing::Test {
 protected:
  mesh::TetMesh mesh = mesh::boxMesh(Vec3(1, 1, 4), Eigen::Vector3i(1, 1, 4));
  BodyConfig body{neoHookean(1e3), {}, {}};

  fem::Composition compose(const Mat3& R_WB = Mat3::Identity()) const {
    return composeBody(body, mesh, R_WB, "scene.yaml", "organs[0]");
  }
  std::vector<Problem> problems() const {
    return test::problemsOf([&] { compose(); });
  }
  double mu(const fem::Composition& composition, int tet) const {
    return material::moduli(composition.solid(tet).law).mu;
  }
};

TEST_F(Composition, OfOneMaterialIsOneSolid) {
  body.material.density = 1060.0;
  body.material.viscoelastic = {{0.4, 0.5}};
  const fem::Composition c = compose();
  ASSERT_EQ(c.solids.size(), 1u);
  EXPECT_TRUE(c.solid_of.empty());
  EXPECT_TRUE(c.frames.empty());
  EXPECT_EQ(c.solids[0].density, 1060.0);
  ASSERT_EQ(c.solids[0].prony.size(), 1u);
  EXPECT_EQ(c.solids[0].prony[0].tau, 0.5);
}

TEST_F(Composition, LaterRegionsHold) {
  body.regions = {region("lower", below(2.0), neoHookean(2e3)),
                  region("lowest", below(1.0), neoHookean(3e3))};
  const fem::Composition c = compose();
  EXPECT_EQ(mu(c, 0), 3e3);
  EXPECT_EQ(mu(c, 6), 2e3);
  EXPECT_EQ(mu(c, 12), 1e3);
  EXPECT_EQ(mu(c, 23), 1e3);
  std::swap(body.regions[0], body.regions[1]);
  EXPECT_EQ(mu(compose(), 0), 2e3);
}

TEST_F(Composition, TurnsConstantDirectionsWithTheBody) {
  body.material = guccione();
  body.fibres = FibreConfig{Vec3(0, 0, 2), Vec3(3, 0, 5), "", ""};
  const Mat3 R = test::Random().rotation();
  const fem::Composition c = compose(R);
  ASSERT_EQ(c.frames.size(), 24u);
  Mat3 in_body;
  in_body.col(0) = Vec3::UnitZ();
  in_body.col(1) = Vec3::UnitX();
  in_body.col(2) = Vec3::UnitY();
  EXPECT_LT((c.frames[17] - R * in_body).norm(), 1e-14);
}

TEST_F(Composition, FindsASheetWhereNoneIsGiven) {
  body.material = guccione();
  for (const Vec3& f : {Vec3(1, 0, 0), Vec3(0, -2, 0), Vec3(0.1, 0.2, -7), Vec3(1, 1, 1)}) {
    body.fibres = FibreConfig{f, {}, "", ""};
    const Mat3 frame = compose().frames[3];
    EXPECT_LT((frame.transpose() * frame - Mat3::Identity()).norm(), 1e-14);
    EXPECT_NEAR(frame.determinant(), 1.0, 1e-14);
    EXPECT_LT((frame.col(0) - f.normalized()).norm(), 1e-15);
  }
}

TEST_F(Composition, ReadsDirectionsOfTheMesh) {
  mesh.cell_data["f"] = Eigen::MatrixXd::Random(3, 24);
  mesh.cell_data["s"] = Eigen::MatrixXd::Random(3, 24);
  body.material = guccione();
  body.fibres = FibreConfig{{}, {}, "f", "s"};
  const fem::Composition c = compose();
  for (int t = 0; t < 24; ++t) {
    const Vec3 f = mesh.cell_data["f"].col(t), s = mesh.cell_data["s"].col(t);
    EXPECT_LT(c.frames[t].col(0).cross(f).norm(), 1e-14);
    EXPECT_GT(c.frames[t].col(0).dot(f), 0.0);
    EXPECT_GT(c.frames[t].col(1).dot(s), 0.0);
    EXPECT_LT(std::abs(c.frames[t].col(2).dot(s)), 1e-14);  // f, s and the sheet in one plane
  }
}

TEST_F(Composition, RegionsMayDifferInDirectionsAlone) {
  body.material = guccione();
  body.fibres = FibreConfig{Vec3::UnitX(), {}, "", ""};
  RegionConfig turned;
  turned.name = "turned";
  turned.select = below(1.0);
  turned.fibres = FibreConfig{Vec3::UnitY(), {}, "", ""};
  body.regions = {turned, region("stiff", below(2.0), guccione())};
  const fem::Composition c = compose();
  EXPECT_EQ(c.frames[0].col(0), Vec3::UnitY());
  EXPECT_EQ(c.frames[6].col(0), Vec3::UnitX());
}

TEST_F(Composition, NeedsDirectionsOnlyWhereTheLawDoes) {
  body.regions = {region("muscle", below(1.0), guccione())};
  EXPECT_TRUE(
      hasProblem(problems(), "organs[0].regions[0].material (region muscle)", "needs directions"));
  mesh.cell_data["f"] = Eigen::MatrixXd::Zero(3, 24);
  mesh.cell_data["f"].row(1).head(6).setOnes();
  body.regions[0].fibres = FibreConfig{{}, {}, "f", ""};
  const fem::Composition c = compose();
  EXPECT_EQ(c.frames[5].col(0), Vec3::UnitY());
  EXPECT_EQ(c.frames[6], Mat3::Identity());
  body.material = guccione();
  EXPECT_TRUE(hasProblem(problems(), "organs[0].material", "needs directions"));
}

TEST_F(Composition, RefusesBadDirectionsNamingTheTetrahedron) {
  mesh.cell_data["f"] = Eigen::MatrixXd::Ones(3, 24);
  mesh.cell_data["s"] = Vec3::UnitZ().replicate(1, 24);
  mesh.cell_data["scalar"] = Eigen::MatrixXd::Ones(1, 24);
  body.material = guccione();
  body.fibres = FibreConfig{{}, {}, "f", "s"};
  EXPECT_NO_THROW(compose());
  mesh.cell_data["s"].col(4) = Vec3(-2, -2, -2);
  EXPECT_TRUE(hasProblem(problems(), "organs[0].fibres.sheet_field", "tetrahedron 5 "));
  EXPECT_TRUE(hasProblem(problems(), "organs[0].fibres.sheet_field", "along the fibre"));
  mesh.cell_data["s"](0, 3) = std::nan("");
  EXPECT_TRUE(hasProblem(problems(), "organs[0].fibres.sheet_field", "tetrahedron 4 "));
  mesh.cell_data["f"].col(2).setZero();
  EXPECT_TRUE(hasProblem(problems(), "organs[0].fibres.field", "tetrahedron 3 "));
  mesh.cell_data["f"](1, 1) = std::nan("");
  EXPECT_TRUE(hasProblem(problems(), "organs[0].fibres.field", "tetrahedron 2 "));
  body.fibres->field = "fibers";
  EXPECT_TRUE(hasProblem(problems(), "organs[0].fibres.field", "it has f, s"));
  body.fibres->field = "scalar";
  EXPECT_TRUE(hasProblem(problems(), "organs[0].fibres.field", "three components"));
  body.fibres = FibreConfig{Vec3(0, 0, 2), Vec3(0, 0, -1), "", ""};
  EXPECT_TRUE(hasProblem(problems(), "organs[0].fibres.sheet", "along the fibre"));
}

TEST_F(Composition, RefusesRegionsWithoutTetrahedra) {
  body.regions = {region("far", mesh::SphereRegion{Vec3(9, 9, 9), 1.0}, neoHookean(1.0))};
  EXPECT_TRUE(hasProblem(problems(), "organs[0].regions[0].select",
                         "reaches from [0, 0, 0] to [1, 1, 4] m in its own frame"));
  body.regions[0].select = mesh::DepthRegion{0.0, 0.01};
  EXPECT_TRUE(hasProblem(problems(), "organs[0].regions[0].select", "lie 0.25 m to 0.25 m below"));
  EXPECT_TRUE(hasProblem(problems(), "organs[0].regions[0].select", "thinner than the tetrahedra"));
  body.regions[0].select = mesh::CellDataRegion{"", 1};
  EXPECT_TRUE(hasProblem(problems(), "organs[0].regions[0].select", "no region tags"));
  mesh.region.assign(24, 2);
  mesh.region[5] = 7;
  EXPECT_TRUE(hasProblem(problems(), "organs[0].regions[0].select", "the values are 2, 7"));
}

TEST_F(Composition, OfACaseHasNoPrefix) {
  body.regions = {region("far", below(-8.0), neoHookean(1.0))};
  EXPECT_TRUE(hasProblem(
      test::problemsOf([&] { composeBody(body, mesh, Mat3::Identity(), "case.yaml", ""); }),
      "regions[0].select", "at least one"));
}

}  // namespace
}  // namespace palpate::scene::composition_test
