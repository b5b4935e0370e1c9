// SPDX-License-Identifier: GPL-3.0-or-later
// What every law in the list must obey; a new law gets these tests by being listed.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <type_traits>

#include "finite_difference.h"
#include "kinks.h"
#include "support/law_types.h"
#include "support/random.h"

namespace palpate::material::material_laws_test {
namespace {

using test::nearKink;
using test::slopeAtZero;

// Laws whose distortional energy knows nothing of the volume.
template <class Law>
constexpr bool kIsIsochoric =
    std::is_base_of_v<IsochoricLaw<Law>, Law> || std::is_same_v<Law, NeoHookean>;

template <class Law>
class EveryLaw : public ::testing::Test {
 protected:
  // Deformations with 0.3 < J, since some laws stop at J = 0, in which the law is not stiffer by
  // orders of magnitude than at rest, as exponentials are somewhere.
  Mat3 deformation() {
    for (;;) {
      const Mat3 F = Mat3::Identity() + random.matrix(0.4);
      if (F.determinant() < 0.3 || nearKink(law, F)) continue;
      if (tangent(law, F).norm() < 100.0 * scale) return F;
    }
  }
  // What an error in a stress or a tangent at F is compared with [Pa].
  double stiffness(const Mat3& F) const { return scale + tangent(law, F).norm(); }

  const Law law{Law::example()};
  const double scale = law.moduli().mu + law.moduli().kappa;  // [Pa]
  test::Random random;
};
TYPED_TEST_SUITE(EveryLaw, test::LawTypes, );

TYPED_TEST(EveryLaw, RestIsEnergyAndStressFree) {
  EXPECT_NEAR(energyDensity(this->law, Mat3::Identity()), 0.0, 1e-12 * this->scale);
  EXPECT_LT(firstPiolaKirchhoff(this->law, Mat3::Identity()).norm(), 1e-12 * this->scale);
}

TYPED_TEST(EveryLaw, StressIsTheEnergyGradient) {
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 F = this->deformation(), dF = this->random.matrix(1.0);
    const double slope =
        slopeAtZero([&](double h) { return energyDensity(this->law, F + h * dF); });
    EXPECT_NEAR(firstPiolaKirchhoff(this->law, F).cwiseProduct(dF).sum(), slope,
                1e-10 * this->stiffness(F));
  }
}

TYPED_TEST(EveryLaw, TangentIsTheStressGradient) {
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 F = this->deformation(), dF = this->random.matrix(1.0);
    const Mat3 slope =
        slopeAtZero([&](double h) { return firstPiolaKirchhoff(this->law, F + h * dF); });
    EXPECT_LT((tangent(this->law, F) * vec(dF) - vec(slope)).norm(), 1e-9 * this->stiffness(F));
  }
}

TYPED_TEST(EveryLaw, DerivativesHoldInsideOut) {
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 F = this->random.matrix(1.5), dF = this->random.matrix(1.0);
    if (!std::isfinite(energyDensity(this->law, F)) || nearKink(this->law, F)) continue;
    if (F.determinant() > -0.1) continue;
    const double slope =
        slopeAtZero([&](double h) { return energyDensity(this->law, F + h * dF); });
    EXPECT_NEAR(firstPiolaKirchhoff(this->law, F).cwiseProduct(dF).sum(), slope,
                1e-10 * this->stiffness(F));
    const Mat3 change =
        slopeAtZero([&](double h) { return firstPiolaKirchhoff(this->law, F + h * dF); });
    EXPECT_LT((tangent(this->law, F) * vec(dF) - vec(change)).norm(), 1e-9 * this->stiffness(F));
  }
}

TYPED_TEST(EveryLaw, TangentIsSymmetric) {
  for (int trial = 0; trial < 20; ++trial) {
    const Mat9 K = tangent(this->law, this->deformation());
    EXPECT_LT((K - K.transpose()).norm(), 1e-13 * K.norm());
  }
}

TYPED_TEST(EveryLaw, IsFrameIndifferentIfItClaimsSo) {
  double worst = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 F = this->deformation(), R = this->random.rotation();
    const double energy = energyDensity(this->law, F);
    const Mat3 stress = firstPiolaKirchhoff(this->law, F);
    const double energy_error = energyDensity(this->law, R * F) - energy;
    const Mat3 stress_error = firstPiolaKirchhoff(this->law, R * F) - R * stress;
    const double error = std::abs(energy_error) + stress_error.norm();
    worst = std::max(worst, error / this->stiffness(F));
  }
  if (TypeParam::kFrameIndifferent) {
    EXPECT_LT(worst, 1e-12);
  } else {
    EXPECT_GT(worst, 1e-3);
  }
}

TYPED_TEST(EveryLaw, StressIsSymmetricInTheDeformedBody) {
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 F = this->deformation(), P = firstPiolaKirchhoff(this->law, F);
    const Mat3 kirchhoff = TypeParam::kFrameIndifferent ? Mat3(P * F.transpose()) : P;
    EXPECT_LT((kirchhoff - kirchhoff.transpose()).norm(), 1e-12 * this->stiffness(F));
  }
}

TYPED_TEST(EveryLaw, IsIsotropicUnlessItHasFibres) {
  double worst = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 F = this->deformation(), Q = this->random.rotation();
    // A law for small rotations has to have the turn undone in the world, too.
    const Mat3 turned = TypeParam::kFrameIndifferent ? Mat3(F * Q) : Mat3(Q.transpose() * F * Q);
    const double error = energyDensity(this->law, turned) - energyDensity(this->law, F);
    worst = std::max(worst, std::abs(error) / this->stiffness(F));
  }
  if (TypeParam::kNeedsFibres) {
    EXPECT_GT(worst, 1e-3);
  } else {
    EXPECT_LT(worst, 1e-12);
  }
}

TYPED_TEST(EveryLaw, RestIsStable) {
  const Mat9 K = tangent(this->law, Mat3::Identity());
  // Ascending: three rotations, then six strains, the softest of which shears with 2 mu.
  const Vec9 stiffnesses = Eigen::SelfAdjointEigenSolver<Mat9>(K).eigenvalues();
  EXPECT_LT(stiffnesses.head<3>().cwiseAbs().maxCoeff(), 1e-12 * this->scale);
  EXPECT_GT(stiffnesses(3), 0.0);
  EXPECT_LT((K * vec(crossMatrix(Vec3(1.0, 2.0, 3.0)))).norm(), 1e-11 * this->scale);
}

// Fibres leave the change of volume and the shear across them to the matrix.
TYPED_TEST(EveryLaw, ObeysHookeAtSmallStrain) {
  const Moduli m = this->law.moduli();
  const Mat9 K = tangent(this->law, Mat3::Identity());
  const auto error = [&](const Mat3& H) {
    const Mat3 hooke = m.mu * (H + H.transpose()) + m.lambda() * H.trace() * Mat3::Identity();
    return (K * vec(H) - vec(hooke)).norm();
  };
  Mat3 shear_across = Mat3::Zero();
  shear_across(1, 2) = 1.0;
  EXPECT_LT(error(shear_across), 1e-12 * this->scale);
  EXPECT_LT(error(Mat3::Identity()), 1e-12 * this->scale);
  if (TypeParam::kNeedsFibres) return;
  for (int n = 0; n < 9; ++n) {
    Mat3 H = Mat3::Zero();
    H(n % 3, n / 3) = 1.0;
    EXPECT_LT(error(H), 1e-12 * this->scale) << "column " << n;
  }
}

TYPED_TEST(EveryLaw, KnowsNoVolumeIfItIsSplitByIt) {
  if constexpr (kIsIsochoric<TypeParam>) {
    for (int trial = 0; trial < 20; ++trial) {
      const Mat3 F = this->deformation();
      for (const double s : {0.2, 0.9, 3.0}) {
        EXPECT_NEAR(this->law.distortionalEnergy(s * F), this->law.distortionalEnergy(F),
                    1e-12 * this->stiffness(F));
      }
      const double pressure = this->law.distortionalStress(F).cwiseProduct(F).sum();
      EXPECT_NEAR(pressure, 0.0, 1e-12 * this->stiffness(F));
    }
  }
}

TYPED_TEST(EveryLaw, DilatationHasItsDerivatives) {
  using Theta = typename TypeParam::Dilatation;
  EXPECT_NEAR(Theta::value(Mat3::Identity()), 0.0, 1e-15);
  EXPECT_LT((Theta::gradient(Mat3::Identity()) - Mat3::Identity()).norm(), 1e-15);
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 F = this->deformation(), dF = this->random.matrix(1.0);
    const double slope = slopeAtZero([&](double h) { return Theta::value(F + h * dF); });
    EXPECT_NEAR(Theta::gradient(F).cwiseProduct(dF).sum(), slope, 1e-10);
    const Mat3 change = slopeAtZero([&](double h) { return Theta::gradient(F + h * dF); });
    Mat9 hessian = Mat9::Constant(1.0);
    Theta::addHessian(F, 2.0, &hessian);
    hessian.array() -= 1.0;
    EXPECT_LT((hessian * vec(dF) - 2.0 * vec(change)).norm(), 1e-9);
  }
}

TYPED_TEST(EveryLaw, StretchingCostsEnergy) {
  for (const double stretch : {0.8, 1.2, 1.5}) {
    EXPECT_GT(energyDensity(this->law, Vec3(stretch, 1.0, 1.0).asDiagonal()), 0.0);
  }
}

TYPED_TEST(EveryLaw, IsFiniteAtLargeStretch) {
  for (const double stretch : {0.3, 0.5, 2.0, 3.0}) {
    const Mat3 F = this->random.rotation() * Vec3(stretch, 1.0, 1.0).asDiagonal();
    EXPECT_TRUE(std::isfinite(energyDensity(this->law, F))) << stretch;
    EXPECT_TRUE(firstPiolaKirchhoff(this->law, F).allFinite()) << stretch;
    EXPECT_TRUE(tangent(this->law, F).allFinite()) << stretch;
  }
}

// A line search asks for the energy of any F, and turns back where it is infinite.
TYPED_TEST(EveryLaw, EnergyIsNeverNaNNorUnboundedBelow) {
  const auto check = [&](const Mat3& F) {
    const double energy = energyDensity(this->law, F);
    EXPECT_FALSE(std::isnan(energy)) << F;
    EXPECT_GT(energy, -1e-9 * this->scale * (1.0 + F.squaredNorm())) << F;
  };
  for (int trial = 0; trial < 200; ++trial) {
    for (const double size : {1e-60, 1e-20, 1e-3, 1.0, 30.0, 1e3, 1e20, 1e50}) {
      check(size * this->random.matrix(1.0));
    }
  }
  for (const double s : {0.0, -1.0, 1e-300, 1e-8, 1e-30, 1e40}) {
    check(Vec3(1.0, 1.0, s).asDiagonal());
    check(Vec3(s, 1.0, s).asDiagonal());
    check(Vec3(s, s, s).asDiagonal());
  }
}

}  // namespace
}  // namespace palpate::material::material_laws_test
