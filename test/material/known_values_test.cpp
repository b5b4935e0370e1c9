// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers that other programs and people find, and laws that coincide where their constants say so.
#include <gtest/gtest.h>

#include "palpate/material/corotational.h"
#include "palpate/material/linear.h"
#include "palpate/material/material.h"
#include "support/law_response.h"
#include "support/random.h"
#include "support/uniaxial.h"

namespace palpate::material::known_values_test {
namespace {

double pull(const std::string& law, const Constants& constants, double stretch) {
  double transverse;
  return test::uniaxialStress(makeMaterial(law, constants), stretch, &transverse);
}

Constants young(double poisson_ratio) {
  return {{"young_modulus", {10.0}}, {"poisson_ratio", {poisson_ratio}}};
}

// mu (l - 1/l^2) with mu = E/3 = 10/3.
TEST(KnownValues, IncompressibleNeoHookeanBar) {
  const double mu = 10.0 / 3.0;
  const Constants yeoh{
      {"c1", {mu / 2}}, {"c2", {0.0}}, {"c3", {0.0}}, {"poisson_ratio", {0.4999999}}};
  EXPECT_NEAR(pull("yeoh", yeoh, 0.6), -7.259259, 2e-6);
  EXPECT_NEAR(pull("yeoh", yeoh, 1.5), 3.518519, 2e-6);
}

TEST(KnownValues, NearlyIncompressibleNeoHookeanBar) {
  EXPECT_NEAR(pull("neo_hookean", young(0.499), 0.6), -7.260244, 1e-6);
  EXPECT_NEAR(pull("neo_hookean", young(0.499), 1.5), 3.516833, 1e-6);
}

TEST(KnownValues, StableNeoHookeanBar) {
  double transverse;
  const Material law = makeMaterial("stable_neo_hookean", young(0.45));
  EXPECT_NEAR(test::uniaxialStress(law, 1.5, &transverse), 3.588761, 1e-6);
  EXPECT_NEAR(transverse, 0.829993, 1e-6);
}

// Energy, stress and tangent agree, in units of the shear modulus 2000 Pa of all the laws below.
void expectSame(const std::string& a, const Constants& of_a, const std::string& b,
                const Constants& of_b, double tolerance = 1e-12) {
  SCOPED_TRACE(a + " and " + b);
  const Material la = makeMaterial(a, of_a), lb = makeMaterial(b, of_b);
  test::Random random;
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 F = Mat3::Identity() + random.matrix(0.3);
    const Mat9 K = test::tangent(la, F);
    const double bound = tolerance * (2000.0 + K.norm());
    EXPECT_NEAR(test::energyDensity(la, F), test::energyDensity(lb, F), bound);
    EXPECT_LT((test::firstPiolaKirchhoff(la, F) - test::firstPiolaKirchhoff(lb, F)).norm(), bound);
    EXPECT_LT((K - test::tangent(lb, F)).norm(), bound);
  }
}

const Constants kNeoHookean{{"mu", {2000.0}}, {"kappa", {9000.0}}};

TEST(CoincidingLaws, ManyContainTheNeoHookean) {
  const std::vector<double> kappa{9000.0};
  expectSame("ogden", {{"mu", {2000.0}}, {"alpha", {2.0}}, {"kappa", kappa}}, "neo_hookean",
             kNeoHookean);
  expectSame("mooney_rivlin", {{"c10", {1000.0}}, {"c01", {0.0}}, {"kappa", kappa}}, "neo_hookean",
             kNeoHookean);
  expectSame("yeoh", {{"c1", {1000.0}}, {"c2", {0.0}}, {"c3", {0.0}}, {"kappa", kappa}},
             "neo_hookean", kNeoHookean);
  expectSame("demiray", {{"a", {2000.0}}, {"b", {1e-9}}, {"kappa", kappa}}, "neo_hookean",
             kNeoHookean, 1e-7);
  expectSame("holzapfel_gasser_ogden",
             {{"mu", {2000.0}},
              {"k1", {0.0, 0.0}},
              {"k2", {5.0, 1e3}},
              {"dispersion", {0.0, 0.3}},
              {"angle", {0.3, 1.0}},
              {"kappa", kappa}},
             "neo_hookean", kNeoHookean);
}

TEST(CoincidingLaws, OgdenWithTwoAndMinusTwoIsMooneyRivlin) {
  expectSame("ogden", {{"mu", {1400.0, -600.0}}, {"alpha", {2.0, -2.0}}, {"kappa", {9000.0}}},
             "mooney_rivlin", {{"c10", {700.0}}, {"c01", {300.0}}, {"kappa", {9000.0}}});
}

TEST(CoincidingLaws, OgdenInAnotherConvention) {
  // 2 mu'/alpha^2 (sum l^alpha - 3), mu' = 1200 and 800, is 2 mu'/alpha here.
  const double a = 3.0, b = -4.0;
  const Material law = makeMaterial(
      "ogden",
      {{"mu", {2.0 * 1200.0 / a, 2.0 * 800.0 / b}}, {"alpha", {a, b}}, {"kappa", {9000.0}}});
  EXPECT_DOUBLE_EQ(moduli(law).mu, 2000.0);
}

TEST(CoincidingLaws, VerondaWestmannOfSmallAlphaIsMooneyRivlin) {
  expectSame("veronda_westmann",
             {{"c1", {7e11}}, {"alpha", {1e-9}}, {"c2", {300.0}}, {"kappa", {9000.0}}},
             "mooney_rivlin", {{"c10", {700.0}}, {"c01", {300.0}}, {"kappa", {9000.0}}}, 1e-7);
}

TEST(CoincidingLaws, HolzapfelOgdenWithoutFibresIsDemiray) {
  expectSame("holzapfel_ogden",
             {{"a", {2000.0}},
              {"b", {1.3}},
              {"af", {0.0}},
              {"bf", {9.0}},
              {"as", {0.0}},
              {"bs", {9.0}},
              {"afs", {0.0}},
              {"bfs", {9.0}},
              {"kappa", {9000.0}}},
             "demiray", {{"a", {2000.0}}, {"b", {1.3}}, {"kappa", {9000.0}}});
}

TEST(CoincidingLaws, CorotationalIsLinearWithoutRotation) {
  test::Random random;
  const Corotational corotational(kNeoHookean);
  const Linear linear(kNeoHookean);
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 A = random.matrix(0.2), F = Mat3::Identity() + A + A.transpose();
    EXPECT_NEAR(energyDensity(corotational, F), energyDensity(linear, F), 1e-10);
    EXPECT_LT((firstPiolaKirchhoff(corotational, F) - firstPiolaKirchhoff(linear, F)).norm(), 1e-9);
  }
}

TEST(CoincidingLaws, EqualExponentsOrFullDispersionLeaveNoDirection) {
  test::Random random;
  for (const Material& material :
       {makeMaterial(
            "guccione",
            {{"c", {1000.0}}, {"bf", {1.0}}, {"bt", {1.0}}, {"bfs", {1.0}}, {"kappa", {9000.0}}}),
        makeMaterial("holzapfel_gasser_ogden", {{"mu", {2000.0}},
                                                {"k1", {500.0}},
                                                {"k2", {1.0}},
                                                {"dispersion", {1.0 / 3.0}},
                                                {"angle", {0.4}},
                                                {"kappa", {9000.0}}})}) {
    for (int trial = 0; trial < 20; ++trial) {
      const Mat3 F = Mat3::Identity() + random.matrix(0.3);
      const double energy = test::energyDensity(material, F);
      EXPECT_NEAR(test::energyDensity(material, F * random.rotation()), energy, 1e-11 * energy);
    }
  }
}

// psi = mu |dev(0, 0, -2)|^2 + kappa/2 2^2 for a body mirrored in z.
TEST(KnownValues, CorotationalInsideOut) {
  const Corotational law(kNeoHookean);
  const Mat3 mirror = Vec3(1.0, 1.0, -1.0).asDiagonal();
  EXPECT_NEAR(energyDensity(law, mirror), 2000.0 * 8.0 / 3.0 + 9000.0 / 2.0 * 4.0, 1e-8);
}

TEST(KnownValues, PoissonRatioGivesKappaOfTheModulusAtRest) {
  const Moduli m = moduli(makeMaterial(
      "mooney_rivlin", {{"c10", {700.0}}, {"c01", {300.0}}, {"poisson_ratio", {0.4}}}));
  EXPECT_DOUBLE_EQ(m.mu, 2000.0);
  EXPECT_NEAR(m.kappa, 2.0 * 2000.0 * 1.4 / (3.0 * 0.2), 1e-9);
}

}  // namespace
}  // namespace palpate::material::known_values_test
