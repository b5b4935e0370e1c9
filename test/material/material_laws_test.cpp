// SPDX-License-Identifier: GPL-3.0-or-later
// What every law in the list must obey; a new law gets these tests by being listed.
#include <gtest/gtest.h>

#include "palpate/material/material.h"
#include "support/random.h"

namespace palpate::material {
namespace {

template <class T>
struct AsTestTypes;
template <class... Laws>
struct AsTestTypes<std::variant<Laws...>> {
  using type = ::testing::Types<Laws...>;
};

template <class Law>
class EveryLaw : public ::testing::Test {
 protected:
  // Deformations with 0.3 < J: laws that stop at J = 0 have their energy there.
  Mat3 deformation() {
    for (;;) {
      const Mat3 F = Mat3::Identity() + random.matrix(0.4);
      if (F.determinant() > 0.3) return F;
    }
  }
  const Law law{Law::example()};
  const double scale = law.moduli().mu + law.moduli().kappa;  // [Pa]
  test::Random random;
};
TYPED_TEST_SUITE(EveryLaw, typename AsTestTypes<Material>::type, );

TYPED_TEST(EveryLaw, RestIsEnergyAndStressFree) {
  EXPECT_NEAR(energyDensity(this->law, Mat3::Identity()), 0.0, 1e-12 * this->scale);
  EXPECT_LT(firstPiolaKirchhoff(this->law, Mat3::Identity()).norm(), 1e-12 * this->scale);
}

TYPED_TEST(EveryLaw, StressIsTheEnergyGradient) {
  constexpr double h = 1e-5;
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 F = this->deformation(), dF = this->random.matrix(1.0);
    const double slope =
        (energyDensity(this->law, F + h * dF) - energyDensity(this->law, F - h * dF)) / (2.0 * h);
    EXPECT_NEAR(firstPiolaKirchhoff(this->law, F).cwiseProduct(dF).sum(), slope,
                1e-8 * this->scale);
  }
}

TYPED_TEST(EveryLaw, TangentIsTheStressGradient) {
  constexpr double h = 1e-6;
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 F = this->deformation(), dF = this->random.matrix(1.0);
    const Mat3 slope =
        (firstPiolaKirchhoff(this->law, F + h * dF) - firstPiolaKirchhoff(this->law, F - h * dF)) /
        (2.0 * h);
    EXPECT_LT((tangent(this->law, F) * vec(dF) - vec(slope)).norm(), 1e-7 * this->scale);
  }
}

TYPED_TEST(EveryLaw, TangentIsSymmetric) {
  for (int trial = 0; trial < 20; ++trial) {
    const Mat9 K = tangent(this->law, this->deformation());
    EXPECT_LT((K - K.transpose()).norm(), 1e-13 * K.norm());
  }
}

TYPED_TEST(EveryLaw, IsFrameIndifferent) {
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 F = this->deformation(), R = this->random.rotation();
    EXPECT_NEAR(energyDensity(this->law, R * F), energyDensity(this->law, F), 1e-11 * this->scale);
    EXPECT_LT(
        (firstPiolaKirchhoff(this->law, R * F) - R * firstPiolaKirchhoff(this->law, F)).norm(),
        1e-11 * this->scale);
  }
}

TYPED_TEST(EveryLaw, StressIsSymmetricInTheDeformedBody) {
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 F = this->deformation();
    const Mat3 kirchhoff = firstPiolaKirchhoff(this->law, F) * F.transpose();
    EXPECT_LT((kirchhoff - kirchhoff.transpose()).norm(), 1e-11 * this->scale);
  }
}

TYPED_TEST(EveryLaw, ObeysHookeAtSmallStrain) {
  const Moduli m = this->law.moduli();
  const Mat9 K = tangent(this->law, Mat3::Identity());
  for (int n = 0; n < 9; ++n) {
    Mat3 H = Mat3::Zero();
    H(n % 3, n / 3) = 1.0;
    const Mat3 hooke = m.mu * (H + H.transpose()) + m.lambda() * H.trace() * Mat3::Identity();
    EXPECT_LT((K.col(n) - vec(hooke)).norm(), 1e-12 * this->scale) << "column " << n;
  }
}

TYPED_TEST(EveryLaw, StretchingCostsEnergy) {
  for (const double stretch : {0.8, 1.2, 1.5}) {
    EXPECT_GT(energyDensity(this->law, Vec3(stretch, 1.0, 1.0).asDiagonal()), 0.0);
  }
}

}  // namespace
}  // namespace palpate::material
