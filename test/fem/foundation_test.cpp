// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/foundation.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "palpate/fem/loads.h"
#include "palpate/mesh/selection.h"
#include "palpate/mesh/tet_mesh.h"
#include "support/random.h"

namespace palpate::fem::foundation_test {
namespace {

constexpr FoundationConstants kConstants{3.0e4, 1.0e4, 200.0, 50.0};

// A box stretched to a parallelepiped, of linear or quadratic tetrahedra; all of it or its bottom.
struct Body {
  explicit Body(bool quadratic)
      : mesh(mesh::boxMesh(Vec3(0.1, 0.2, 0.3), Eigen::Vector3i(2, 3, 4))) {
    if (quadratic) mesh = mesh::toQuadratic(mesh);
  }
  Eigen::MatrixXi bottom() const {
    return selectFaces(mesh::boundaryFaces(mesh),
                       mesh::selectPoints(mesh.points, mesh::PlaneRegion{}));
  }
  mesh::TetMesh mesh;
};

class Foundations : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(LinearAndQuadratic, Foundations, ::testing::Bool());

TEST_P(Foundations, DrawAPlaneBackByItsAreaAndNoMore) {
  const Body body(GetParam());
  const Foundation foundation(body.mesh.points, body.bottom(), kConstants);
  Points g = Points::Zero(3, body.mesh.numPoints());
  EXPECT_EQ(foundation.addGradient(body.mesh.points, &g), 0.0);
  EXPECT_TRUE(g.isZero(0.0));
  const Vec3 u(1e-3, -2e-3, 3e-3);
  const Points x = body.mesh.points.colwise() + u;
  const double energy = foundation.addGradient(x, &g);
  const Vec3 expected = 0.02 * Vec3(1.0e4 * u.x(), 1.0e4 * u.y(), 3.0e4 * u.z());  // area 0.1 x 0.2
  EXPECT_LT((g.rowwise().sum() - expected).norm(), 1e-12 * expected.norm());
  EXPECT_NEAR(energy, 0.5 * u.dot(expected), 1e-12 * energy);
}

TEST_P(Foundations, HaveTheDerivativesOfTheirEnergy) {
  const Body body(GetParam());
  const Eigen::Index n = body.mesh.numPoints();
  Foundation foundation(body.mesh.points, mesh::boundaryFaces(body.mesh), kConstants);
  test::Random random;
  foundation.moveAnchors(Vec3(1e-3, 2e-3, -1e-3));
  foundation.beginStep(0.01, body.mesh.points + random.points(n, 0.01));
  foundation.moveAnchors(Vec3(2e-3, 2e-3, -1e-3));
  const Points x = body.mesh.points + random.points(n, 0.01);
  Points g = Points::Zero(3, n);
  EXPECT_EQ(foundation.addGradient(x, &g), foundation.value(x));
  Stiffness K(BlockMatrix(static_cast<int>(n), {}));
  foundation.addHessian(x, Tangent::kExact, &K);
  constexpr double h = 1e-4;
  for (int trial = 0; trial < 5; ++trial) {
    const Points d = random.points(n, 1.0);
    const double slope = (foundation.value(x + h * d) - foundation.value(x - h * d)) / (2.0 * h);
    EXPECT_NEAR(g.cwiseProduct(d).sum(), slope, 1e-8 * g.norm() * d.norm());
    Points Kd, plus = Points::Zero(3, n), minus = plus;
    K.multiply(d, &Kd);
    foundation.addGradient(x + h * d, &plus);
    foundation.addGradient(x - h * d, &minus);
    EXPECT_LT((Kd - (plus - minus) / (2.0 * h)).norm(), 1e-9 * Kd.norm());
  }
}

TEST_P(Foundations, DampMotionAgainstTheirAnchors) {
  const Body body(GetParam());
  const Points& X = body.mesh.points;
  Foundation foundation(X, body.bottom(), {0.0, 0.0, 200.0, 50.0});
  foundation.beginStep(0.01, X);
  const Vec3 way(1e-3, 0.0, 2e-3);
  Points g = Points::Zero(3, X.cols());
  foundation.addGradient(X.colwise() + way, &g);
  const Vec3 expected = 0.02 / 0.01 * Vec3(50.0 * way.x(), 0.0, 200.0 * way.z());
  EXPECT_LT((g.rowwise().sum() - expected).norm(), 1e-12 * expected.norm());
  foundation.moveAnchors(way);  // they go along
  g.setZero();
  foundation.addGradient(X.colwise() + way, &g);
  EXPECT_LT(g.norm(), 1e-15);
}

TEST(Foundation, BoundsTheFrequenciesOfItsSprings) {
  const Body body(false);
  const Eigen::Index n = body.mesh.numPoints();
  const Foundation foundation(body.mesh.points, mesh::boundaryFaces(body.mesh), kConstants);
  Stiffness K(BlockMatrix(static_cast<int>(n), {}));
  foundation.addHessian(body.mesh.points, Tangent::kExact, &K);
  const Eigen::VectorXd masses = Eigen::VectorXd::LinSpaced(n, 0.001, 0.002);
  double largest = 0.0;
  for (int i = 0; i < n; ++i) {
    const Mat3 block = K.blocks().block(K.blocks().diagonal(i)) / masses[i];
    largest = std::max(largest, block.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff());
  }
  EXPECT_NEAR(foundation.largestSquare(masses), largest, 1e-12 * largest);
}

TEST(Foundation, HoldsABodyAsItsSpringsDo) {
  const Body body(false);
  const Points& X = body.mesh.points;
  const FreeMask free = FreeMask::Ones(3, X.cols());
  const auto motions = [&](const FoundationConstants& constants) {
    std::vector<HeldDirection> held;
    Foundation(X, body.bottom(), constants).addHeldDirections(&held);
    return freeRigidMotions(X, free, held);
  };
  EXPECT_EQ(motions({1.0, 1.0, 0.0, 0.0}), "");
  EXPECT_EQ(motions({1.0, 0.0, 0.0, 0.0}),
            "translation along x, translation along y, rotation about z");
  EXPECT_NE(motions({0.0, 0.0, 1.0, 1.0}), "");  // dashpots hold nothing
}

}  // namespace
}  // namespace palpate::fem::foundation_test
