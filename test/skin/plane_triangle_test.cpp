// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/plane_triangle.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <string>

namespace palpate::skin::plane_triangle_test {
namespace {

constexpr double kE = 0.2e6, kNu = 0.48, kPi = 3.14159265358979323846;

Corners rightTriangle(double side) {
  Corners corners;
  corners << 0.0, 0.0, side, 0.0, side, 0.0;  // the published element 1: (i, j), (i, j+1), (i+1, j)
  return corners;
}

// By hand, of legs a along x and z: with s = E t/2/(1 - nu^2) and g = (1 - nu)/2.
TEST(PlaneTriangle, StiffnessIsThatComputedByHand) {
  constexpr double t = 0.002, s = 0.5 * kE * t / (1.0 - kNu * kNu), g = 0.5 * (1.0 - kNu);
  Eigen::Matrix<double, 6, 6> K;
  K << 1 + g, kNu + g, -g, -kNu, -1, -g,  //
      kNu + g, 1 + g, -g, -1, -kNu, -g,   //
      -g, -g, g, 0, 0, g,                 //
      -kNu, -1, 0, 1, kNu, 0,             //
      -1, -kNu, 0, kNu, 1, 0,             //
      -g, -g, g, 0, 0, g;
  const auto D = elasticityMatrix(Idealization::kPlaneStress, kE, kNu);
  for (const double side : {0.00075, 0.1}) {  // the size does not matter in a plane
    const TriangleStiffness ours =
        triangleStiffness(rightTriangle(side), D, Idealization::kPlaneStress, t);
    EXPECT_LT((ours - s * K).cwiseAbs().maxCoeff(), 1e-12 * s);
  }
}

// B of the published appendix is 2A B = [[L 0 0 0 -L 0], [0 L 0 -L 0 0], [L L -L 0 0 -L]]; its z
// and ours go down, its rows by d/dx and d/dz of the corners have the other sign.
TEST(PlaneTriangle, StrainsAreThoseOfThePrint) {
  constexpr double L = 0.75;
  Eigen::Matrix<double, 3, 6> published;
  published << L, 0, 0, 0, -L, 0, 0, L, 0, -L, 0, 0, L, L, -L, 0, 0, -L;
  const TriangleStrain B = strainMatrix(rightTriangle(L), Idealization::kPlaneStress);
  EXPECT_LT((B.topRows<3>() + published / (L * L)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(B.row(3).norm(), 0.0);
}

TEST(PlaneTriangle, ThePublishedPrefactorIsTooSoft) {
  const auto right = elasticityMatrix(Idealization::kPlaneStress, kE, kNu);
  const auto published = elasticityMatrix(Idealization::kPlaneStressPublished, kE, kNu);
  EXPECT_LT((right - 1.2304 / 0.7696 * published).norm(), 1e-9 * kE);
}

// Plane strain is plane stress of E/(1 - nu^2) and nu/(1 - nu).
TEST(PlaneTriangle, PlaneStrainIsPlaneStressOfOtherConstants) {
  const auto strain = elasticityMatrix(Idealization::kPlaneStrain, kE, kNu);
  const auto stress =
      elasticityMatrix(Idealization::kPlaneStress, kE / (1 - kNu * kNu), kNu / (1 - kNu));
  EXPECT_LT((strain - stress).norm(), 1e-9 * strain.norm());
}

TEST(PlaneTriangle, RigidMotionsExertNoForce) {
  std::mt19937 rng{20050601};
  std::uniform_real_distribution<double> u(0.5, 1.5);
  for (const std::string& name : idealizationNames()) {
    const Idealization kind = idealizationOf(name);
    EXPECT_EQ(toString(kind), name);
    Corners corners;
    corners << u(rng), u(rng) + 2.0, u(rng), u(rng), u(rng), u(rng) + 2.0;
    const TriangleStiffness K =
        triangleStiffness(corners, elasticityMatrix(kind, kE, kNu), kind, 0.01);
    EXPECT_LT((K - K.transpose()).norm(), 1e-12 * K.norm());
    Eigen::Matrix<double, 6, 1> up, along, turn;
    for (int i = 0; i < 3; ++i) {
      along.segment<2>(2 * i) << 1, 0;
      up.segment<2>(2 * i) << 0, 1;
      turn.segment<2>(2 * i) << -corners(1, i), corners(0, i);
    }
    EXPECT_LT((K * up).norm(), 1e-12 * K.norm()) << name;
    if (kind == Idealization::kAxisymmetric) {
      EXPECT_GT(along.dot(K * along), 1e-3 * K.norm());  // a ring that is widened resists
      continue;
    }
    EXPECT_LT((K * along).norm(), 1e-12 * K.norm()) << name;
    EXPECT_LT((K * turn).norm(), 1e-11 * K.norm()) << name;
  }
}

// All strains of u = (a x, b z) are constant in rings: energy is 1/2 e D e times the volume.
TEST(PlaneTriangle, RingsHaveTheirVolumeAndHoopStrain) {
  Corners corners;
  corners << 1.0, 1.3, 1.1, 0.2, 0.3, 0.9;
  const auto D = elasticityMatrix(Idealization::kAxisymmetric, kE, kNu);
  const TriangleStiffness K =
      triangleStiffness(corners, D, Idealization::kAxisymmetric, 123.0);  // no thickness
  const Eigen::Vector4d strain(0.01, -0.03, 0.0, 0.01);
  Eigen::Matrix<double, 6, 1> moved;
  for (int i = 0; i < 3; ++i)
    moved.segment<2>(2 * i) << 0.01 * corners(0, i), -0.03 * corners(1, i);
  const double volume = 2.0 * kPi * corners.row(0).mean() * signedArea(corners);  // Pappus
  EXPECT_NEAR(moved.dot(K * moved), volume * strain.dot(D * strain), 1e-9 * K.norm());
}

TEST(PlaneTriangle, RefusesAnUnknownName) {
  EXPECT_THROW(idealizationOf("plane"), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::skin::plane_triangle_test
