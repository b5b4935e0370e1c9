// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/loads.h"

#include <gtest/gtest.h>

#include <numeric>

#include "palpate/mesh/tet_mesh.h"
#include "support/random.h"

namespace palpate::fem::loads_test {
namespace {

const mesh::TetMesh kBox = mesh::boxMesh(Vec3(0.1, 0.2, 0.3), Eigen::Vector3i(2, 3, 4));
const Eigen::Matrix3Xi kSurface = mesh::boundaryTriangles(kBox.tets);

std::vector<int> topNodes() {
  std::vector<int> nodes;
  for (Eigen::Index i = 0; i < kBox.numPoints(); ++i) {
    if (kBox.points(2, i) > 0.299) nodes.push_back(static_cast<int>(i));
  }
  return nodes;
}

TEST(SelectFaces, TakesFacesWhoseCornersAreAllSelected) {
  EXPECT_EQ(selectFaces(kSurface, topNodes()).cols(), 2 * 2 * 3);
  EXPECT_EQ(selectFaces(kSurface, {0, 1}).cols(), 0);
}

TEST(Traction, SumsToTractionTimesArea) {
  const Vec3 traction(1.0, -2.0, 3.0);
  const Points f = tractionForces(kBox.points, selectFaces(kSurface, topNodes()), traction);
  EXPECT_LT((f.rowwise().sum() - 0.02 * traction).norm(), 1e-15);
}

TEST(FollowerPressure, PushesInwardAndTurnsWithTheBody) {
  const FollowerPressure pressure(selectFaces(kSurface, topNodes()), 50.0);
  const Mat3 R = Eigen::AngleAxisd(0.7, Vec3::UnitX()).toRotationMatrix();
  Points g = Points::Zero(3, kBox.numPoints());
  pressure.addGradient(R * kBox.points, &g);
  const Vec3 force = -g.rowwise().sum();
  EXPECT_LT((force - R * Vec3(0.0, 0.0, -50.0 * 0.02)).norm(), 1e-14);
}

TEST(FollowerPressure, OnAClosedSurfaceIsTheGradientOfItsValue) {
  const FollowerPressure pressure(kSurface, 50.0);
  test::Random random;
  const Points x = kBox.points + random.points(kBox.numPoints(), 0.01);
  Points g = Points::Zero(3, kBox.numPoints());
  pressure.addGradient(x, &g);
  constexpr double h = 1e-5;
  for (int trial = 0; trial < 10; ++trial) {
    const Points d = random.points(kBox.numPoints(), 1.0);
    const double slope = (pressure.value(x + h * d) - pressure.value(x - h * d)) / (2.0 * h);
    EXPECT_NEAR(g.cwiseProduct(d).sum(), slope, 1e-8 * g.norm() * d.norm());
  }
  EXPECT_LT(g.rowwise().sum().norm(), 1e-14);  // a closed surface feels no net force
}

TEST(FollowerPressure, HessianOnAClosedSurfaceIsThatOfTheGradient) {
  const FollowerPressure pressure(kSurface, 50.0);
  std::vector<std::pair<int, int>> pairs;
  for (Eigen::Index e = 0; e < kBox.numTets(); ++e) {
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < a; ++b) pairs.emplace_back(kBox.tets(a, e), kBox.tets(b, e));
    }
  }
  Stiffness K(BlockMatrix(static_cast<int>(kBox.numPoints()), pairs));
  test::Random random;
  const Points x = kBox.points + random.points(kBox.numPoints(), 0.01);
  pressure.addHessian(x, Tangent::kExact, &K);
  const Points d = random.points(kBox.numPoints(), 1.0);
  Points Kd, plus = Points::Zero(3, x.cols()), minus = plus;
  K.multiply(d, &Kd);
  constexpr double h = 1e-5;
  pressure.addGradient(x + h * d, &plus);
  pressure.addGradient(x - h * d, &minus);
  EXPECT_LT((Kd - (plus - minus) / (2.0 * h)).norm(), 1e-9 * Kd.norm());
}

// The same on 6-node faces, bent.
struct Bent {
  mesh::TetMesh mesh = mesh::toQuadratic(kBox);
  Eigen::MatrixXi faces = mesh::boundaryFaces(mesh);
  test::Random random;
  Points x = mesh.points + random.points(mesh.numPoints(), 0.004);
};

TEST(Traction, OnQuadraticFacesLoadsTheMiddlesOfTheEdges) {
  const Bent bent;
  const Vec3 traction(1.0, -2.0, 3.0);
  const Eigen::MatrixXi top = selectFaces(bent.faces, topNodes());
  ASSERT_EQ(top.cols(), 12);
  const Points f = tractionForces(bent.mesh.points, top, traction);
  EXPECT_LT((f.rowwise().sum() - 0.02 * traction).norm(), 1e-15);
  EXPECT_LT(f.col(top(0, 0)).norm(), 1e-15);  // no force on the corners of straight faces
}

TEST(FollowerPressure, OnBentQuadraticFacesIsTheGradientOfItsValue) {
  Bent bent;
  const FollowerPressure pressure(bent.faces, 50.0);
  Points g = Points::Zero(3, bent.x.cols());
  pressure.addGradient(bent.x, &g);
  constexpr double h = 1e-5;
  for (int trial = 0; trial < 10; ++trial) {
    const Points d = bent.random.points(bent.x.cols(), 1.0);
    const double slope =
        (pressure.value(bent.x + h * d) - pressure.value(bent.x - h * d)) / (2.0 * h);
    EXPECT_NEAR(g.cwiseProduct(d).sum(), slope, 1e-8 * g.norm() * d.norm());
  }
  EXPECT_LT(g.rowwise().sum().norm(), 1e-13);
}

TEST(FollowerPressure, HessianOnBentQuadraticFacesIsThatOfTheGradient) {
  Bent bent;
  const FollowerPressure pressure(bent.faces, 50.0);
  std::vector<std::pair<int, int>> pairs;
  for (Eigen::Index t = 0; t < bent.faces.cols(); ++t) {
    for (int a = 0; a < 6; ++a) {
      for (int b = 0; b < a; ++b) pairs.emplace_back(bent.faces(a, t), bent.faces(b, t));
    }
  }
  Stiffness K(BlockMatrix(static_cast<int>(bent.x.cols()), pairs));
  pressure.addHessian(bent.x, Tangent::kExact, &K);
  const Points d = bent.random.points(bent.x.cols(), 1.0);
  Points Kd, plus = Points::Zero(3, bent.x.cols()), minus = plus;
  K.multiply(d, &Kd);
  constexpr double h = 1e-6;
  pressure.addGradient(bent.x + h * d, &plus);
  pressure.addGradient(bent.x - h * d, &minus);
  EXPECT_LT((Kd - (plus - minus) / (2.0 * h)).norm(), 1e-7 * Kd.norm());
}

}  // namespace
}  // namespace palpate::fem::loads_test
