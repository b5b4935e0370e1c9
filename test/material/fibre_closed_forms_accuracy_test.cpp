// SPDX-License-Identifier: GPL-3.0-or-later
// Every law with fibres against d psi, derived by hand along three paths of constant volume.
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

const double kKappa = 7000.0;  // [Pa], of no effect along these paths

double cube(double x) { return x * x * x; }

struct Fibrous {
  std::string law;
  Constants constants;
  std::function<double(double l)> uniaxial;     // l along x, 1/sqrt l aside
  std::function<double(double l)> equibiaxial;  // l along x and y
  std::function<double(double g)> shear;        // F = I + g e1 e2^T
};
void PrintTo(const Fibrous& c, std::ostream* out) { *out << c.law; }

// d/dl of k/(2 b) (exp(b E^2) - 1), for fibres that resist tension only.
double pulled(double k, double b, double E, double dE) {
  return E > 0.0 ? k * E * std::exp(b * E * E) * dE : 0.0;
}

// One family: k1 = 900, k2 = 0.7, dispersion 0.1, 40 degrees; E = 0.1 (I1 - 3) + 0.7 (I4 - 1).
const double kCos = std::cos(0.7), kSin = std::sin(0.7);
double gasserUniaxial(double l) {
  const double E =
      0.1 * (l * l + 2.0 / l - 3.0) + 0.7 * (kCos * kCos * l * l + kSin * kSin / l - 1);
  const double dE =
      0.1 * (2.0 * l - 2.0 / (l * l)) + 0.7 * (2.0 * kCos * kCos * l - kSin * kSin / (l * l));
  return 600.0 * (l - 1.0 / (l * l)) + pulled(900.0, 0.7, E, dE);
}
double gasserEquibiaxial(double l) {
  const double E = 0.1 * (2.0 * l * l + std::pow(l, -4) - 3.0) + 0.7 * (l * l - 1.0);
  const double dE = 0.1 * (4.0 * l - 4.0 * std::pow(l, -5)) + 1.4 * l;
  return 1200.0 * (l - std::pow(l, -5)) + pulled(900.0, 0.7, E, dE);
}
double gasserShear(double g) {
  const double E = 0.1 * g * g + 0.7 * (2.0 * g * kSin * kCos + g * g * kSin * kSin);
  const double dE = 0.2 * g + 0.7 * (2.0 * kSin * kCos + 2.0 * g * kSin * kSin);
  return 600.0 * g + pulled(900.0, 0.7, E, dE);
}

// a = 600, b = 0.9; af = 1800, bf = 1.6; as = 700, bs = 1.1; afs = 200, bfs = 1.3.
double myocardiumUniaxial(double l) {
  return 600.0 * std::exp(0.9 * (l * l + 2.0 / l - 3.0)) * (l - 1.0 / (l * l)) +
         pulled(1800.0, 1.6, l * l - 1.0, 2.0 * l) +
         pulled(700.0, 1.1, 1.0 / l - 1.0, -1.0 / (l * l));
}
double myocardiumEquibiaxial(double l) {
  const double x = 2.0 * l * l + std::pow(l, -4) - 3.0;
  return 1200.0 * std::exp(0.9 * x) * (l - std::pow(l, -5)) +
         pulled(1800.0, 1.6, l * l - 1.0, 2.0 * l) + pulled(700.0, 1.1, l * l - 1.0, 2.0 * l);
}
double myocardiumShear(double g) {
  return 600.0 * std::exp(0.9 * g * g) * g + 1400.0 * std::exp(1.1 * g * g * g * g) * cube(g) +
         200.0 * std::exp(1.3 * g * g) * g;
}

// c = 880, bf = 8, bt = 2, bfs = 4: psi' = c/2 exp(Q) Q'.
double guccioneUniaxial(double l) {
  const double along = 0.5 * (l * l - 1.0), aside = 0.5 * (1.0 / l - 1.0);
  const double Q = 8.0 * along * along + 4.0 * aside * aside;
  return 440.0 * std::exp(Q) * (16.0 * along * l - 4.0 * aside / (l * l));
}
double guccioneEquibiaxial(double l) {
  const double in_plane = 0.5 * (l * l - 1.0), across = 0.5 * (std::pow(l, -4) - 1.0);
  const double Q = 10.0 * in_plane * in_plane + 2.0 * across * across;
  return 440.0 * std::exp(Q) * (20.0 * in_plane * l - 8.0 * across * std::pow(l, -5));
}
double guccioneShear(double g) {
  const double Q = 0.5 * g * g * g * g + 2.0 * g * g;
  return 440.0 * std::exp(Q) * (2.0 * cube(g) + 4.0 * g);
}

const std::vector<Fibrous> kFibrous{
    {"holzapfel_gasser_ogden",
     {{"mu", {600.0}},
      {"k1", {900.0}},
      {"k2", {0.7}},
      {"dispersion", {0.1}},
      {"angle", {0.7}},
      {"kappa", {kKappa}}},
     gasserUniaxial,
     gasserEquibiaxial,
     gasserShear},
    {"holzapfel_ogden",
     {{"a", {600.0}},
      {"b", {0.9}},
      {"af", {1800.0}},
      {"bf", {1.6}},
      {"as", {700.0}},
      {"bs", {1.1}},
      {"afs", {200.0}},
      {"bfs", {1.3}},
      {"kappa", {kKappa}}},
     myocardiumUniaxial,
     myocardiumEquibiaxial,
     myocardiumShear},
    {"guccione",
     {{"c", {880.0}}, {"bf", {8.0}}, {"bt", {2.0}}, {"bfs", {4.0}}, {"kappa", {kKappa}}},
     guccioneUniaxial,
     guccioneEquibiaxial,
     guccioneShear},
};

class FibrousLaw : public ::testing::TestWithParam<Fibrous> {
 protected:
  const Material law = makeMaterial(GetParam().law, GetParam().constants);
};

// P : dF/dl along the path, in which the pressure has no part.
TEST_P(FibrousLaw, Uniaxial) {
  test::ClosedFormRecord record(GetParam().law, "stretch along the fibre");
  for (const double l : {0.7, 0.9, 1.05, 1.2, 1.4}) {
    const double side = 1.0 / std::sqrt(l), dside = -0.5 * side / l;
    const Mat3 P = stress(law, Vec3(l, side, side).asDiagonal());
    const double expected = GetParam().uniaxial(l);
    record.compare(P(0, 0) + dside * (P(1, 1) + P(2, 2)), expected);
  }
}

TEST_P(FibrousLaw, Equibiaxial) {
  test::ClosedFormRecord record(GetParam().law, "equal stretch along fibre and sheet");
  for (const double l : {0.8, 0.95, 1.1, 1.3}) {
    const Mat3 P = stress(law, Vec3(l, l, 1.0 / (l * l)).asDiagonal());
    const double expected = GetParam().equibiaxial(l);
    record.compare(P(0, 0) + P(1, 1) - 2.0 / cube(l) * P(2, 2), expected);
  }
}

TEST_P(FibrousLaw, SimpleShear) {
  test::ClosedFormRecord record(GetParam().law, "simple shear along the fibre");
  for (const double g : {-0.5, -0.1, 0.2, 0.6}) {
    Mat3 F = Mat3::Identity();
    F(0, 1) = g;
    const double expected = GetParam().shear(g);
    record.compare(stress(law, F)(0, 1), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, FibrousLaw, ::testing::ValuesIn(kFibrous),
                         [](const auto& c) { return c.param.law; });

// A law that is listed and has no closed form here.
TEST(ClosedForms, CoverTheFibrousLaws) {
  for (const std::string& name : materialNames()) {
    if (!needsFibres(makeMaterial(name, exampleConstants(name)))) continue;
    bool covered = false;
    for (const auto& c : kFibrous) covered = covered || c.law == name;
    EXPECT_TRUE(covered) << name;
  }
}

}  // namespace
}  // namespace palpate::material
