// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/fem/inversion_guard.h"

#include <gtest/gtest.h>

#include "palpate/mesh/tet_mesh.h"
#include "support/random.h"

namespace palpate::fem::inversion_guard_test {
namespace {

class FlatElements : public ::testing::TestWithParam<bool> {
 protected:
  FlatElements() {
    mesh = mesh::boxMesh(Vec3(0.02, 0.02, 0.02), Eigen::Vector3i(2, 2, 2));
    if (GetParam()) mesh = mesh::toQuadratic(mesh);
    guard = std::make_unique<InversionGuard>(mesh, 1e4);
    guard->setActive(true);
  }
  // Pressed to `height` of what it was, with some disorder.
  Points pressed(double height) {
    Points x = mesh.points + random.points(mesh.numPoints(), 3e-4);
    x.row(2) *= height;
    return x;
  }

  mesh::TetMesh mesh;
  std::unique_ptr<InversionGuard> guard;
  test::Random random;
};

TEST_P(FlatElements, AreLeftAloneUntilTheyAreFlat) {
  const Points x = pressed(0.3);
  ASSERT_GT(guard->least(x), InversionGuard::kLeast);
  Points g = Points::Zero(3, x.cols());
  EXPECT_EQ(guard->addGradient(x, &g), 0.0);
  EXPECT_TRUE(g.isZero(0.0));
  EXPECT_NEAR(guard->least(mesh.points), 1.0, 1e-12);
}

TEST_P(FlatElements, GradientAndHessianAreThoseOfTheValue) {
  for (const double height : {0.09, 0.05, 0.012, 0.003, -0.05}) {
    const Points x = pressed(height);
    Points g = Points::Zero(3, x.cols());
    EXPECT_DOUBLE_EQ(guard->addGradient(x, &g), guard->value(x));
    ASSERT_GT(g.norm(), 0.0);
    std::vector<std::pair<int, int>> pairs;
    for (int a = 0; a < x.cols(); ++a) {
      for (int b = 0; b < a; ++b) pairs.emplace_back(a, b);
    }
    Stiffness K(BlockMatrix(static_cast<int>(x.cols()), pairs));
    guard->addHessian(x, Tangent::kExact, &K);
    const Points d = random.points(x.cols(), 1.0);
    constexpr double h = 1e-9;
    EXPECT_NEAR(g.cwiseProduct(d).sum(),
                (guard->value(x + h * d) - guard->value(x - h * d)) / (2.0 * h),
                1e-5 * g.norm() * d.norm());
    Points Kd, plus = Points::Zero(3, x.cols()), minus = plus;
    K.multiply(d, &Kd);
    guard->addGradient(x + h * d, &plus);
    guard->addGradient(x - h * d, &minus);
    EXPECT_LT((Kd - (plus - minus) / (2.0 * h)).norm(), 1e-4 * Kd.norm()) << height;
  }
}

TEST_P(FlatElements, AreMadeThickerByItsForces) {
  for (const double height : {0.05, -0.05}) {
    const Points x = pressed(height);
    Points g = Points::Zero(3, x.cols());
    guard->addGradient(x, &g);
    const Points thicker = x - 1e-7 / g.cwiseAbs().maxCoeff() * g;
    EXPECT_LT(guard->value(thicker), guard->value(x));
    EXPECT_LT(g.rowwise().sum().norm(), 1e-12 * g.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(LinearAndQuadratic, FlatElements, ::testing::Bool());

}  // namespace
}  // namespace palpate::fem::inversion_guard_test
