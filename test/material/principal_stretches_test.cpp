// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "finite_difference.h"
#include "palpate/material/ogden.h"
#include "palpate/material/principal_stretches.h"
#include "support/random.h"

namespace palpate::material::principal_stretches_test {
namespace {

using test::slopeAtZero;

void expectDecomposes(const Mat3& F) {
  const PrincipalStretches p = principalStretches(F);
  const double size = F.cwiseAbs().maxCoeff();
  EXPECT_LE((p.U * p.s.asDiagonal() * p.V.transpose() - F).cwiseAbs().maxCoeff(), 1e-14 * size);
  for (const Mat3& R : {p.U, p.V, p.rotation()}) {
    EXPECT_LT((R.transpose() * R - Mat3::Identity()).norm(), 1e-14) << F;
    EXPECT_NEAR(R.determinant(), 1.0, 1e-14) << F;
  }
  EXPECT_GE(p.s(0), p.s(1) * (1.0 - 1e-14));
  EXPECT_GE(p.s(1), std::abs(p.s(2)) - 1e-14 * p.s(0));
}

TEST(PrincipalStretches, OfAnyMatrix) {
  test::Random random;
  for (int trial = 0; trial < 1000; ++trial) {
    Mat3 F = random.matrix(1.0);
    expectDecomposes(F);
    expectDecomposes(1e200 * F);
    expectDecomposes(1e-250 * F);
    expectDecomposes(Mat3::Identity() + 1e-9 * F);
    F.col(2) = 0.3 * F.col(0) - F.col(1);  // flat
    expectDecomposes(F);
    F.col(1) = 2.0 * F.col(0);
    F.col(2) = -F.col(0);  // a line
    expectDecomposes(F);
  }
}

TEST(PrincipalStretches, OfSpecialMatrices) {
  expectDecomposes(Mat3::Zero());
  expectDecomposes(Mat3::Identity());
  expectDecomposes(-Mat3::Identity());
  expectDecomposes(Vec3(0.0, 0.0, -2.0).asDiagonal());
  expectDecomposes(Vec3(1.0, 3.0, 2.0).asDiagonal());
  expectDecomposes(Vec3(1e-20, 1.0, 1e-9).asDiagonal());
  expectDecomposes(Mat3::Ones());
}

TEST(PrincipalStretches, OnlyTheLastCarriesTheSign) {
  test::Random random;
  for (int trial = 0; trial < 100; ++trial) {
    const Mat3 F = random.matrix(1.0);
    const Vec3 s = principalStretches(F).s;
    EXPECT_GT(s(1), 0.0);
    EXPECT_EQ(s(2) > 0.0, F.determinant() > 0.0);
  }
}

TEST(PrincipalStretches, RotationIsTheNearest) {
  test::Random random;
  for (int trial = 0; trial < 100; ++trial) {
    const Mat3 F = random.matrix(1.0), R = principalStretches(F).rotation();
    for (int k = 0; k < 20; ++k) {
      EXPECT_LE((F - R).norm(), (F - random.rotation()).norm());
    }
  }
}

TEST(PrincipalStretches, ModesAreAnOrthonormalBasis) {
  const PrincipalStretches p = principalStretches(test::Random().matrix(1.0));
  Mat9 modes;
  for (int i = 0; i < 3; ++i) {
    modes.col(i) = p.stretchMode(i);
    modes.col(3 + i) = p.flipMode(i, (i + 1) % 3);
    modes.col(6 + i) = p.twistMode(i, (i + 1) % 3);
  }
  EXPECT_LT((modes.transpose() * modes - Mat9::Identity()).norm(), 1e-14);
}

TEST(PrincipalStretches, RotationDerivative) {
  test::Random random;
  for (int trial = 0; trial < 100; ++trial) {
    const Mat3 F = random.matrix(1.5), dF = random.matrix(1.0);
    const PrincipalStretches p = principalStretches(F);
    if (p.s(1) + p.s(2) < 0.1) continue;  // the rotation is about to flip
    const Mat3 slope =
        slopeAtZero([&](double h) { return principalStretches(F + h * dF).rotation(); });
    Mat9 derivative = Mat9::Zero();
    addRotationDerivative(p, 1.0, &derivative);
    EXPECT_LT((derivative * vec(dF) - vec(slope)).norm(), 1e-6);
  }
}

// Stretches that coincide, or almost: where a divided difference would lose its digits.
TEST(Ogden, TangentOfEqualStretches) {
  const Ogden law(Ogden::example());
  test::Random random;
  for (const double gap : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3}) {
    for (const Vec3& stretches :
         {Vec3(1.0, 1.0 + gap, 1.0 - gap), Vec3(1.3, 1.3 + gap, 0.7), Vec3(0.8, 0.8 - gap, 1.4)}) {
      const Mat3 F = random.rotation() * stretches.asDiagonal() * random.rotation();
      const Mat3 dF = random.matrix(1.0);
      const Mat3 slope = slopeAtZero([&](double h) { return law.distortionalStress(F + h * dF); });
      EXPECT_LT((law.distortionalTangent(F) * vec(dF) - vec(slope)).norm(), 1e-9 * 1e4) << gap;
    }
  }
}

}  // namespace
}  // namespace palpate::material::principal_stretches_test
