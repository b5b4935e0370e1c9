// SPDX-License-Identifier: GPL-3.0-or-later
// Projected tangents against all eigenvectors of them.
#include "fem/psd_projection.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "support/law_types.h"
#include "support/random.h"

namespace palpate::fem::psd_projection_test {
namespace {

Mat9 projectedByAll(const Mat9& A) {
  const Eigen::SelfAdjointEigenSolver<Mat9> eigen(A);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

double leastEigenvalue(const Mat9& A) {
  return Eigen::SelfAdjointEigenSolver<Mat9>(A, Eigen::EigenvaluesOnly).eigenvalues().minCoeff();
}

// Squeezed, sheared, flat, inside out, with singular values that are alike.
Mat3 deformation(int trial, test::Random* random) {
  Vec3 stretches = Vec3::Constant(0.4) + random->vector(0.5);
  if (trial % 5 == 1) stretches[1] = stretches[0];
  if (trial % 5 == 2) stretches.setConstant(stretches[0]);
  if (trial % 5 == 3) stretches[2] = 0.0;
  return random->rotation() * stretches.asDiagonal() * random->rotation();
}

template <class Law>
bool isIsotropic(const Law& law) {
  test::Random random;
  const Mat3 F = Mat3::Identity() + random.matrix(0.2);
  const double energy = material::energyDensity(law, F);
  return std::abs(material::energyDensity(law, Mat3(F * random.rotation())) - energy) <
         1e-6 * energy;
}

template <class Law>
class EveryLawProjected : public ::testing::Test {};
TYPED_TEST_SUITE(EveryLawProjected, test::LawTypes, );

TYPED_TEST(EveryLawProjected, IsThatOfAllEigenvectors) {
  const TypeParam law{TypeParam::example()};
  test::Random random;
  int negative = 0, known = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Mat3 F = deformation(trial, &random);
    const Mat9 A = material::tangent(law, F);
    if (!A.allFinite() || A.norm() > 1e6 * (law.moduli().mu + law.moduli().kappa)) continue;
    Mat9 projected = A;
    const Projected how = projectToPositiveSemidefinite(F, &projected);
    const double scale = A.norm();
    EXPECT_LT((projected - projectedByAll(A)).norm(), 1e-8 * scale) << F;
    EXPECT_GT(leastEigenvalue(projected), -1e-8 * scale) << F;
    EXPECT_LT((projected - projected.transpose()).norm(), 1e-13 * scale) << F;
    if (how == Projected::kNothing) {
      EXPECT_EQ(projected, A);
    }
    negative += how != Projected::kNothing;
    known += how == Projected::kByKnown;
  }
  EXPECT_GE(negative, known);
  if (isIsotropic(law)) {
    EXPECT_EQ(known, negative);
  }
}

TEST(PsdProjection, KnowsTheEigenvectorsOfIsotropicLaws) {
  const material::NeoHookean law{material::NeoHookean::example()};
  test::Random random;
  for (int trial = 0; trial < 300; ++trial) {
    const Mat3 F = deformation(trial, &random);
    Mat9 A = material::tangent(law, F);
    if (!A.allFinite()) continue;
    EXPECT_NE(projectToPositiveSemidefinite(F, &A), Projected::kByAll) << F;
  }
}

TEST(PsdProjection, LooksWhetherTheyAreOnes) {
  test::Random random;
  for (int trial = 0; trial < 50; ++trial) {
    Mat9 A = Mat9::NullaryExpr([&] { return random.uniform(-1.0, 1.0); });
    A = (A + A.transpose()).eval();
    const Mat9 expected = projectedByAll(A);
    EXPECT_EQ(projectToPositiveSemidefinite(random.matrix(1.0), &A), Projected::kByAll);
    EXPECT_LT((A - expected).norm(), 1e-13 * expected.norm());
  }
}

TEST(PsdProjection, LeavesWhatIsNotFinite) {
  Mat9 A = Mat9::Identity();
  A(3, 3) = std::nan("");
  EXPECT_EQ(projectToPositiveSemidefinite(Mat3::Identity(), &A), Projected::kNothing);
  EXPECT_TRUE(std::isnan(A(3, 3)));
  Mat9 B = -Mat9::Identity();
  EXPECT_NE(projectToPositiveSemidefinite(Mat3::Constant(std::nan("")), &B), Projected::kNothing);
  EXPECT_LT(B.norm(), 1e-15);
}

}  // namespace
}  // namespace palpate::fem::psd_projection_test
