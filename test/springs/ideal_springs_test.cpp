// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/ideal_springs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace palpate::springs::ideal_springs_test {
namespace {

constexpr double E = 2.1e6, I = 3.0e-9, U = 0.013;
const BeamSection kBeam{E, 1.0e-5, I};
const Sheet kSheet{1.0e6, 0.3, 1.5e-3};

struct Curves {
  IdealSprings springs;
  double spacing, first_force, second_force, first_slope, second_slope;  // (4.25-4.30), (4.50-4.61)
};

Curves beam() {
  const double EI = E * I;
  return {IdealSprings::ofBeam(kBeam, U),
          U,
          4 * EI / (U * U),
          -2 * EI / (U * U),
          4 * EI / (U * U * U),
          EI / (2 * U * U * U)};
}

Curves triangles() {
  const double nuD = (1 + kSheet.poisson_ratio) * kSheet.bendingStiffness(), root = std::sqrt(3.0);
  return {IdealSprings::ofTriangles(kSheet, U),
          U,
          4 * root * nuD / (3 * U),
          -2 * root * nuD / (3 * U),
          4 * root * nuD / (3 * U * U),
          root * nuD / (6 * U * U)};
}

TEST(IdealSprings, LimitsOfSmallCurvature) {
  for (const Curves& c : {beam(), triangles()}) {
    const double rho = 1e-6 / U;
    EXPECT_NEAR(c.springs.structuralForce(rho), c.first_force, 1e-6 * c.first_force);
    EXPECT_NEAR(c.springs.flexionForce(rho), c.second_force, -1e-6 * c.second_force);
    EXPECT_NEAR(c.springs.structuralLimit().force, c.first_force, 1e-12 * c.first_force);
    EXPECT_NEAR(c.springs.flexionLimit().force, c.second_force, -1e-12 * c.second_force);
    EXPECT_NEAR(c.springs.structuralLimit().slope, c.first_slope, 1e-6 * c.first_slope);
    EXPECT_NEAR(c.springs.flexionLimit().slope, c.second_slope, 1e-6 * c.second_slope);
    EXPECT_DOUBLE_EQ(c.springs.structuralLimit().spacing, U);
    EXPECT_DOUBLE_EQ(c.springs.flexionLimit().spacing, 2 * U);
  }
}

// By the printed formulas, where these do not cancel.
TEST(IdealSprings, CurvesOfABeam) {
  const IdealSprings springs = IdealSprings::ofBeam(kBeam, U);
  for (const double rho : {0.5 / U, 1.0 / U, 2.0 / U}) {
    const double first = 2 * E * I * rho * rho * std::cos(U * rho / 2) / (1 - std::cos(U * rho));
    const double second = E * I * rho * rho / (std::cos(U * rho) - 1);
    EXPECT_NEAR(springs.structuralForce(rho), first, 1e-12 * first);
    EXPECT_NEAR(springs.flexionForce(rho), second, -1e-12 * second);
    EXPECT_NEAR(springs.structuralSpacing(rho), 2 / rho * std::sin(U * rho / 2), 1e-14 * U);
    EXPECT_NEAR(springs.flexionSpacing(rho), 2 / rho * std::sin(U * rho), 1e-14 * U);
  }
}

// (4.12): a mass between two bent neighbours is in balance, and (4.2, 4.3): the work of the two
// springs over the curvature is that of bending, E I U rho^2 / 2 a node.
TEST(IdealSprings, BalanceAndWorkOfBending) {
  const IdealSprings springs = IdealSprings::ofBeam(kBeam, U);
  for (const double rho : {0.1 / U, 0.7 / U, 1.3 / U}) {
    EXPECT_NEAR(springs.structuralForce(rho),
                -2 * springs.flexionForce(rho) * std::cos(U * rho / 2),
                1e-12 * springs.structuralForce(rho));
    const double h = 1e-4 * rho;
    const double work = springs.structuralForce(rho) * (springs.structuralSpacing(rho + h) -
                                                        springs.structuralSpacing(rho - h)) +
                        springs.flexionForce(rho) *
                            (springs.flexionSpacing(rho + h) - springs.flexionSpacing(rho - h));
    EXPECT_NEAR(work / (2 * h), E * I * U * rho, 1e-6 * E * I * U * rho);
  }
}

// Digits of the reference: square errors in (E I)^2/U^3, rest lengths in U.
TEST(IdealSprings, RestLengthsWithTheLeastError) {
  const IdealSprings springs = IdealSprings::ofBeam(kBeam, U);
  const double unit = E * I * E * I / (U * U * U), rho = std::sqrt(2.0) / U;
  EXPECT_NEAR(springs.structuralRestLength(rho) / U, 0.139, 0.0005);
  EXPECT_NEAR(springs.flexionRestLength(rho) / U, 5.44, 0.005);
  EXPECT_NEAR(springs.structuralError(0.0, rho) / unit, 8.1e-5, 0.05e-5);
  EXPECT_NEAR(springs.flexionError(6 * U, rho) / unit, 5.2e-4, 0.05e-4);
  EXPECT_NEAR(springs.structuralRestLength(0.1 * rho) / U, 0.0015, 0.00005);
  EXPECT_NEAR(springs.flexionRestLength(0.1 * rho) / U, 5.994, 0.0005);
  EXPECT_NEAR(springs.structuralRestLength(1e-3 * rho) / U, 0.0, 1e-6);
  EXPECT_NEAR(springs.flexionRestLength(1e-3 * rho) / U, 6.0, 1e-6);
}

TEST(IdealSprings, TheRestLengthIsAMinimum) {
  for (const Curves& c : {beam(), triangles()}) {
    const double rho = std::sqrt(2.0) / U;
    const double L1 = c.springs.structuralRestLength(rho), L2 = c.springs.flexionRestLength(rho);
    for (const double change : {-0.01 * U, 0.01 * U}) {
      EXPECT_GT(c.springs.structuralError(L1 + change, rho), c.springs.structuralError(L1, rho));
      EXPECT_GT(c.springs.flexionError(L2 + change, rho), c.springs.flexionError(L2, rho));
    }
  }
}

TEST(IdealSprings, RefusesConstantsOutOfRange) {
  EXPECT_THROW(IdealSprings::ofBeam({0.0, 1.0, 1.0}, U), std::invalid_argument);
  EXPECT_THROW(IdealSprings::ofBeam(kBeam, -U), std::invalid_argument);
  EXPECT_THROW(IdealSprings::ofTriangles({1.0, 0.5, 1.0}, U), std::invalid_argument);
  EXPECT_THROW(IdealSprings::ofTriangles({1.0, 0.3, std::nan("")}, U), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::springs::ideal_springs_test
