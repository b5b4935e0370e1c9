// SPDX-License-Identifier: GPL-3.0-or-later
// Every law without fibres against formulas derived by hand from its energy as a function of the
// principal stretches.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>

#include "closed_form_record.h"
#include "palpate/material/material.h"
#include "support/law_response.h"

namespace palpate::material {
namespace {

Mat3 stress(const Material& material, const Mat3& F) {
  return test::firstPiolaKirchhoff(material, F);
}

struct Isotropic {
  std::string law;
  Constants constants;
  std::function<Vec3(const Vec3& l)> slopes;  // d psi/d l_i of psi(l1, l2, l3) [Pa]
};
void PrintTo(const Isotropic& c, std::ostream* out) { *out << c.law; }

// psi = W(lbar) + kappa/2 (J - 1)^2: from b_i = lbar_i dW/dlbar_i, with lbar = J^(-1/3) l, follows
// l_i dpsi/dl_i = b_i - mean b + kappa J (J - 1).
std::function<Vec3(const Vec3&)> isochoric(const std::function<Vec3(const Vec3& lbar)>& b,
                                           double kappa) {
  return [=](const Vec3& l) -> Vec3 {
    const double J = l.prod();
    const Vec3 bi = b(l / std::cbrt(J));
    return (bi.array() - bi.mean() + kappa * J * (J - 1.0)) / l.array();
  };
}

// With W(I1, I2), b_i = 2 W1 l_i^2 + 2 W2 l_i^2 (I1 - l_i^2).
Vec3 fromInvariants(const Vec3& l, const std::function<double(double x1)>& W1, double W2) {
  const Eigen::Array3d squares = l.array().square();
  const double I1 = squares.sum();
  return 2.0 * W1(I1 - 3.0) * squares + 2.0 * W2 * squares * (I1 - squares);
}

const double kMu = 2000.0, kKappa = 7000.0, kLambda = kKappa - 2.0 / 3.0 * kMu;
const Constants kModuli{{"mu", {kMu}}, {"kappa", {kKappa}}};

Vec3 hookeOfStretches(const Vec3& l) {
  const double trace = l.sum() - 3.0;
  return kLambda * trace * Vec3::Ones() + 2.0 * kMu * (l - Vec3::Ones());
}

const std::vector<Isotropic> kIsotropic{
    {"corotational", kModuli, hookeOfStretches},
    {"st_venant_kirchhoff", kModuli,
     [](const Vec3& l) -> Vec3 {
       const Eigen::Array3d E = 0.5 * (l.array().square() - 1.0);
       return l.array() * (kLambda * E.sum() + 2.0 * kMu * E);
     }},
    {"stable_neo_hookean", kModuli,
     [](const Vec3& l) -> Vec3 {
       const double J = l.prod();
       return kMu * l.array() + (-kMu + (kLambda + kMu) * (J - 1.0)) * J / l.array();
     }},
    {"neo_hookean", kModuli,
     isochoric([](const Vec3& l) -> Vec3 { return kMu * l.array().square(); }, kKappa)},
    {"mooney_rivlin",
     {{"c10", {700.0}}, {"c01", {-150.0}}, {"kappa", {kKappa}}},
     isochoric(
         [](const Vec3& l) {
           return fromInvariants(
               l, [](double) { return 700.0; }, -150.0);
         },
         kKappa)},
    {"yeoh",
     {{"c1", {500.0}}, {"c2", {-90.0}}, {"c3", {110.0}}, {"kappa", {kKappa}}},
     isochoric(
         [](const Vec3& l) {
           return fromInvariants(
               l, [](double x) { return 500.0 - 180.0 * x + 330.0 * x * x; }, 0.0);
         },
         kKappa)},
    {"veronda_westmann",
     {{"c1", {300.0}}, {"alpha", {1.7}}, {"kappa", {kKappa}}},
     isochoric(
         [](const Vec3& l) {
           return fromInvariants(
               l, [](double x) { return 510.0 * std::exp(1.7 * x); }, -255.0);
         },
         kKappa)},
    {"demiray",
     {{"a", {900.0}}, {"b", {2.1}}, {"kappa", {kKappa}}},
     isochoric(
         [](const Vec3& l) {
           return fromInvariants(
               l, [](double x) { return 450.0 * std::exp(2.1 * x); }, 0.0);
         },
         kKappa)},
    {"ogden",
     {{"mu", {630.0, -120.0, 2.0}}, {"alpha", {1.3, -2.0, 5.0}}, {"kappa", {kKappa}}},
     isochoric(
         [](const Vec3& l) -> Vec3 {
           return 630.0 * l.array().pow(1.3) - 120.0 * l.array().pow(-2.0) +
                  2.0 * l.array().pow(5.0);
         },
         kKappa)},
};

class IsotropicLaw : public ::testing::TestWithParam<Isotropic> {
 protected:
  const Material law = makeMaterial(GetParam().law, GetParam().constants);
  void compare(const Vec3& l, test::ClosedFormRecord* record) const {
    record->compare(stress(law, l.asDiagonal()), Mat3(GetParam().slopes(l).asDiagonal()));
  }
};

TEST_P(IsotropicLaw, Uniaxial) {
  test::ClosedFormRecord record(GetParam().law, "stretch along one axis");
  for (const double stretch : {0.6, 0.8, 1.1, 1.5, 2.0}) {
    for (const double side : {0.85, 1.0, 1.2}) compare({side, side, stretch}, &record);
  }
}

TEST_P(IsotropicLaw, Equibiaxial) {
  test::ClosedFormRecord record(GetParam().law, "equal stretch along two axes");
  for (const double stretch : {0.7, 0.9, 1.2, 1.6}) {
    for (const double thickness : {0.5, 0.8, 1.1}) compare({stretch, stretch, thickness}, &record);
  }
}

TEST_P(IsotropicLaw, ThreeStretches) {
  test::ClosedFormRecord record(GetParam().law, "three different stretches");
  compare({0.7, 1.1, 1.4}, &record);
}

// F = I + g e1 e2^T has the stretches l, 1/l, 1 with l - 1/l = g, and F F^T the first direction
// (l, 1)/sqrt(1 + l^2): the Cauchy stress follows, all components.
TEST_P(IsotropicLaw, SimpleShear) {
  test::ClosedFormRecord record(GetParam().law, "simple shear");
  for (const double g : {-0.4, 0.1, 0.5, 1.0}) {
    const double l = 0.5 * g + std::sqrt(1.0 + 0.25 * g * g);
    const Vec3 stretches(l, 1.0 / l, 1.0);
    const Vec3 cauchy = GetParam().slopes(stretches).cwiseProduct(stretches);
    Mat3 directions = Mat3::Identity();
    directions.topLeftCorner<2, 2>() << l, -1.0, 1.0, l;
    directions.topLeftCorner<2, 2>() /= std::sqrt(1.0 + l * l);
    const Mat3 expected = directions * cauchy.asDiagonal() * directions.transpose();
    Mat3 F = Mat3::Identity();
    F(0, 1) = g;
    record.compare(stress(law, F) * F.transpose(), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, IsotropicLaw, ::testing::ValuesIn(kIsotropic),
                         [](const auto& c) { return c.param.law; });

TEST(LinearLaw, IsHookeInEveryComponent) {
  const Material law = makeMaterial("linear", kModuli);
  Mat3 F = Mat3::Identity();
  F.diagonal() = Vec3(0.9, 0.9, 1.3);
  test::ClosedFormRecord stretched("linear", "three different stretches");
  stretched.compare(stress(law, F), Mat3(hookeOfStretches({0.9, 0.9, 1.3}).asDiagonal()));
  F = Mat3::Identity();
  F(0, 1) = 0.3;
  Mat3 shear = Mat3::Zero();
  shear(0, 1) = shear(1, 0) = 0.3 * kMu;
  test::ClosedFormRecord sheared("linear", "simple shear");
  sheared.compare(stress(law, F), shear);
}

// A law that is listed and has no closed form here.
TEST(ClosedForms, CoverTheIsotropicLaws) {
  for (const std::string& name : materialNames()) {
    if (needsFibres(makeMaterial(name, exampleConstants(name)))) continue;
    bool covered = name == "linear";
    for (const auto& c : kIsotropic) covered = covered || c.law == name;
    EXPECT_TRUE(covered) << name;
  }
}

}  // namespace
}  // namespace palpate::material
