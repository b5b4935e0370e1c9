// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/cavity.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "palpate/fem/loads.h"
#include "palpate/mesh/cavities.h"
#include "support/hollow.h"
#include "support/random.h"

namespace palpate::fem::cavity_test {
namespace {

constexpr CavityContent kBile{1000.0, 2.0e4, false};

// The hollow cube, of linear or quadratic tetrahedra.
struct Hollow {
  explicit Hollow(bool quadratic) : mesh(test::hollowCube()) {
    if (quadratic) mesh = mesh::toQuadratic(mesh);
    const Eigen::MatrixXi surface = mesh::boundaryFaces(mesh);
    wall = selectFaces(surface, mesh::cavityNodes(mesh)[0]);
    std::vector<std::pair<int, int>> pairs;
    for (Eigen::Index t = 0; t < wall.cols(); ++t) {
      for (Eigen::Index a = 0; a < wall.rows(); ++a) {
        for (Eigen::Index b = 0; b < a; ++b) pairs.emplace_back(wall(a, t), wall(b, t));
      }
    }
    K = Stiffness(BlockMatrix(static_cast<int>(mesh.numPoints()), pairs));
  }
  mesh::TetMesh mesh;
  Eigen::MatrixXi wall;
  Stiffness K;
};

class Cavities : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(LinearAndQuadratic, Cavities, ::testing::Bool());

TEST_P(Cavities, HaveTheDerivativesOfTheirEnergy) {
  Hollow h(GetParam());
  const Eigen::Index n = h.mesh.numPoints();
  test::Random random;
  for (const bool balanced : {false, true}) {
    CavityContent content = kBile;
    content.balanced = balanced;
    CavityPressure cavity(h.mesh.points, h.wall, content);
    cavity.seal(h.mesh.points);
    const Points x = h.mesh.points + random.points(n, 0.002);
    Points g = Points::Zero(3, n);
    EXPECT_EQ(cavity.addGradient(x, &g), cavity.value(x));
    h.K.setZero();
    cavity.addHessian(x, Tangent::kExact, &h.K);
    EXPECT_EQ(h.K.rankOnes().size(), 1u);
    EXPECT_TRUE(h.K.couplings().empty());
    constexpr double s = 1e-6;
    for (int trial = 0; trial < 5; ++trial) {
      const Points d = random.points(n, 1.0);
      const double slope = (cavity.value(x + s * d) - cavity.value(x - s * d)) / (2.0 * s);
      EXPECT_NEAR(g.cwiseProduct(d).sum(), slope, 1e-6 * g.norm() * d.norm());
      Points Kd, plus = Points::Zero(3, n), minus = plus;
      h.K.multiply(d, &Kd);
      cavity.addGradient(x + s * d, &plus);
      cavity.addGradient(x - s * d, &minus);
      EXPECT_LT((Kd - (plus - minus) / (2.0 * s)).norm(), 1e-6 * Kd.norm());
    }
    EXPECT_LT(g.rowwise().sum().norm(), 1e-14);  // no net force
  }
}

TEST_P(Cavities, FollowTheLawOfTheirContent) {
  const Hollow h(GetParam());
  CavityPressure cavity(h.mesh.points, h.wall, kBile);
  const double V = 8e-6;  // 20 mm cubed
  EXPECT_NEAR(cavity.volume(h.mesh.points), V, 1e-12 * V);
  const Points larger = 1.1 * h.mesh.points;
  EXPECT_EQ(cavity.pressure(larger), 1000.0);  // nothing is sealed in yet
  cavity.seal(h.mesh.points);
  EXPECT_NEAR(cavity.pressure(larger), 1000.0 - 2.0e4 * (1.331 - 1.0), 1e-8);
  const double dV = 0.331 * V;
  EXPECT_NEAR(cavity.value(larger), 0.5 * 2.0e4 / V * dV * dV - 1000.0 * dV, 1e-12);
  CavityContent content = kBile;
  content.balanced = true;
  CavityPressure balanced(h.mesh.points, h.wall, content);
  balanced.seal(h.mesh.points);
  Points g = Points::Zero(3, h.mesh.numPoints());
  balanced.addGradient(h.mesh.points, &g);
  EXPECT_TRUE(g.isZero(1e-12));
  EXPECT_EQ(balanced.pressure(h.mesh.points), 1000.0);
  EXPECT_NEAR(balanced.value(larger), 0.5 * 2.0e4 / V * dV * dV, 1e-12);
}

TEST_P(Cavities, BoundTheirFrequencies) {
  Hollow h(GetParam());
  const Eigen::Index n = h.mesh.numPoints();
  const Eigen::VectorXd masses = Eigen::VectorXd::LinSpaced(n, 0.001, 0.002);
  for (const CavityContent& content : {CavityContent{1000.0, 0.0, false}, kBile}) {
    CavityPressure cavity(h.mesh.points, h.wall, content);
    cavity.seal(h.mesh.points);
    h.K.setZero();
    cavity.addHessian(h.mesh.points, Tangent::kExact, &h.K);
    // Nodes elsewhere have no stiffness.
    const std::vector<int> nodes = mesh::cavityNodes(h.mesh)[0];
    const auto size = 3 * static_cast<Eigen::Index>(nodes.size());
    Eigen::MatrixXd dense(size, size);
    const auto scaled = [&](const Points& x) -> Points {
      return x * masses.cwiseSqrt().cwiseInverse().asDiagonal();
    };
    for (Eigen::Index c = 0; c < size; ++c) {
      Points unit = Points::Zero(3, n), column;
      unit(c % 3, nodes[static_cast<std::size_t>(c / 3)]) = 1.0;
      h.K.multiply(scaled(unit), &column);
      const Points wall = scaled(column)(Eigen::all, nodes);
      dense.col(c) = Eigen::Map<const Eigen::VectorXd>(wall.data(), wall.size());
    }
    const double largest = dense.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff();
    const double bound = cavity.largestSquare(h.mesh.points, masses);
    std::printf("largest square %.4g, bound %.4g 1/s^2\n", largest, bound);
    EXPECT_GE(bound, largest);
    EXPECT_LE(bound, 20.0 * largest);
  }
}

TEST(Cavity, NeedsFacesThatEncloseIt) {
  const Hollow h(false);
  EXPECT_TRUE(CavityPressure(h.mesh.points, h.wall, kBile).conservative());
  const Eigen::MatrixXi open = h.wall.leftCols(h.wall.cols() - 1);
  EXPECT_THROW(CavityPressure(h.mesh.points, open, kBile), std::invalid_argument);
  EXPECT_FALSE(CavityPressure(h.mesh.points, open, {1000.0, 0.0, false}).conservative());
}

}  // namespace
}  // namespace palpate::fem::cavity_test
