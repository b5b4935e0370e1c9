// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "palpate/fem/elasticity.h"
#include "support/random.h"

namespace palpate::fem {
namespace {

const material::Constants kConstants{{"young_modulus", {5.0e3}}, {"poisson_ratio", {0.3}}};

// A box whose inner nodes are moved, so that no two elements are alike.
TetMesh distortedBox(test::Random* random, int cells = 3) {
  TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.12, 0.09), Eigen::Vector3i::Constant(cells));
  const Vec3 high = mesh.points.rowwise().maxCoeff();
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    const Vec3 p = mesh.points.col(i);
    if ((p.array() <= 0.0).any() || (p.array() >= high.array()).any()) continue;
    mesh.points.col(i) += random->vector(0.1 * 0.1 / cells);
  }
  return mesh;
}

class Tet4 : public ::testing::TestWithParam<std::string> {
 protected:
  test::Random random;
  TetMesh mesh = distortedBox(&random);
  std::unique_ptr<Elasticity> body =
      makeElasticity("tet4", mesh, material::makeMaterial(GetParam(), kConstants));
};

TEST_P(Tet4, GradientIsThatOfTheEnergy) {
  const Points x = mesh.points + random.points(mesh.numPoints(), 0.002);
  Points g;
  EXPECT_DOUBLE_EQ(body->gradient(x, &g), body->energy(x));
  constexpr double h = 1e-6;
  for (int trial = 0; trial < 10; ++trial) {
    const Points d = random.points(mesh.numPoints(), 1.0);
    const double slope = (body->energy(x + h * d) - body->energy(x - h * d)) / (2.0 * h);
    EXPECT_NEAR(g.cwiseProduct(d).sum(), slope, 1e-7 * g.norm() * d.norm());
  }
}

TEST_P(Tet4, HessianIsThatOfTheGradient) {
  const Points x = mesh.points + random.points(mesh.numPoints(), 0.002);
  BlockMatrix K = body->makeMatrix();
  body->hessian(x, Tangent::kExact, &K);
  constexpr double h = 1e-7;
  for (int trial = 0; trial < 5; ++trial) {
    const Points d = random.points(mesh.numPoints(), 1.0);
    Points Kd, plus, minus;
    K.multiply(d, &Kd);
    body->gradient(x + h * d, &plus);
    body->gradient(x - h * d, &minus);
    EXPECT_LT((Kd - (plus - minus) / (2.0 * h)).norm(), 1e-6 * Kd.norm());
  }
}

TEST_P(Tet4, ProjectedHessianIsPositiveSemidefinite) {
  const Points x = 0.8 * mesh.points + random.points(mesh.numPoints(), 0.004);
  BlockMatrix K = body->makeMatrix();
  body->hessian(x, Tangent::kProjected, &K);
  Eigen::MatrixXd dense(3 * K.numNodes(), 3 * K.numNodes());
  dense.setZero();
  for (int i = 0; i < K.numNodes(); ++i) {
    for (int s = K.rowBegin(i); s < K.rowEnd(i); ++s) {
      dense.block<3, 3>(3 * i, 3 * K.column(s)) = K.block(s);
    }
  }
  EXPECT_LT((dense - dense.transpose()).norm(), 1e-12 * dense.norm());
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly).eigenvalues();
  EXPECT_GT(eigenvalues.minCoeff(), -1e-8 * eigenvalues.maxCoeff());
}

TEST_P(Tet4, RigidMotionIsFree) {
  const Mat3 R = Eigen::AngleAxisd(M_PI / 2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Points x = (R * mesh.points).colwise() + Vec3(0.3, -0.2, 0.1);
  Points g, stretched;
  body->gradient(x, &g);
  body->gradient(1.01 * mesh.points, &stretched);
  EXPECT_LT(g.norm(), 1e-12 * stretched.norm() / 0.01);
}

TEST_P(Tet4, HomogeneousStretchIsInEquilibriumInside) {
  const Mat3 F = Mat3::Identity() + random.matrix(0.1);
  const Points x = F * mesh.points;
  Points g;
  body->gradient(x, &g);
  const Vec3 high = mesh.points.rowwise().maxCoeff();
  for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
    const Vec3 p = mesh.points.col(i);
    if ((p.array() <= 0.0).any() || (p.array() >= high.array()).any()) continue;
    EXPECT_LT(g.col(i).norm(), 1e-12 * g.norm());
  }
}

TEST_P(Tet4, ForcesSumToZero) {
  Points g;
  body->gradient(mesh.points + random.points(mesh.numPoints(), 0.002), &g);
  EXPECT_LT(g.rowwise().sum().norm(), 1e-13 * g.norm());
}

TEST_P(Tet4, ThreadsDoNotChangeABit) {
  const Points x = mesh.points + random.points(mesh.numPoints(), 0.002);
  ThreadPool pool(3);
  const auto threaded =
      makeElasticity("tet4", mesh, material::makeMaterial(GetParam(), kConstants), &pool);
  Points g, g_threaded;
  EXPECT_EQ(body->gradient(x, &g), threaded->gradient(x, &g_threaded));
  EXPECT_EQ(g, g_threaded);
  BlockMatrix K = body->makeMatrix(), K_threaded = body->makeMatrix();
  body->hessian(x, Tangent::kExact, &K);
  threaded->hessian(x, Tangent::kExact, &K_threaded);
  for (int s = 0; s < K.numBlocks(); ++s) ASSERT_EQ(Mat3(K.block(s)), Mat3(K_threaded.block(s)));
}

INSTANTIATE_TEST_SUITE_P(EveryLaw, Tet4, ::testing::ValuesIn(material::materialNames()),
                         [](const auto& law) { return law.param; });

TEST(MakeElasticity, RefusesWhatItCannotUse) {
  TetMesh mesh = mesh::boxMesh(Vec3::Ones(), Eigen::Vector3i::Ones());
  const material::Material law = material::makeMaterial("neo_hookean", kConstants);
  EXPECT_THROW(makeElasticity("tet5", mesh, law), std::invalid_argument);
  std::swap(mesh.tets(0, 3), mesh.tets(1, 3));
  try {
    makeElasticity("tet4", mesh, law);
    FAIL() << "an inverted tetrahedron was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("tetrahedron 4"), std::string::npos) << error.what();
  }
}

TEST(NodalVolumes, SumToTheBody) {
  const TetMesh mesh = mesh::boxMesh(Vec3(0.1, 0.2, 0.3), Eigen::Vector3i(2, 3, 4));
  const auto body = makeElasticity("tet4", mesh, material::makeMaterial("neo_hookean", kConstants));
  EXPECT_NEAR(body->nodalVolumes().sum(), 0.006, 1e-15);
}

}  // namespace
}  // namespace palpate::fem
