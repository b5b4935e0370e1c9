// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of masses against the closed forms of [Wang 2005, appendices A and B].
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "palpate/springs/network_statics.h"
#include "palpate/springs/spring_grids.h"

namespace palpate::springs::beam_statics_test {
namespace {

constexpr double E = 1.0e7;

// Deflection of the middle under a unit force, 2 n spacings between the clamps, which hold two
// nodes each.
double middleStiffness(const LineSprings& springs, double U, int n) {
  const SpringNetwork line = lineNetwork(springs, U, 2 * n + 3, 1.0);
  NetworkLoads loads = noLoads(line);
  const Eigen::Index last = line.points.cols() - 1, middle = n + 1;
  for (const Eigen::Index i : {Eigen::Index{0}, Eigen::Index{1}, last - 1, last}) {
    loads.free.col(i).setZero();
  }
  loads.free.row(0).setZero();
  loads.free.row(1).setZero();
  loads.forces(2, middle) = 1.0;
  const auto moved =
      linearDisplacements(line, line.points, loads, Points::Zero(3, line.points.cols()));
  if (!moved) return -1.0;
  return 1.0 / (*moved)(2, middle);
}

TEST(BeamStatics, ClampedBeamGoesAlongTheCurveOfAppendixA) {
  const std::map<int, double> reference = {{2, 0.476},  {4, 0.686},  {8, 0.828}, {10, 0.860},
                                           {16, 0.910}, {32, 0.954}, {64, 0.977}};
  const BeamSection beam = rectangularSection(E, 0.1, 0.1);
  constexpr double L = 32.0;
  for (const auto& [n, ratio] : reference) {
    const double U = L / (2 * n), limit = 192 * E * beam.second_moment / (L * L * L);
    const double stiffness = middleStiffness(lineSprings(beam, U), U, n);
    const double N = n;
    EXPECT_NEAR(stiffness / limit, ratio, 0.0005) << n;
    const double curve = 2 * E * beam.second_moment / (U * U * U) * (12 * N + 6) /
                         (N * N * N * N + 2 * N * N * N + 2 * N * N + N);
    EXPECT_NEAR(stiffness, curve, 1e-8 * curve) << n;
  }
}

// Displacements along a free line of 30 masses: the first spring's shortening, spring by spring.
Eigen::VectorXd shortenings(const BeamSection& beam, double U, double k2) {
  SpringNetwork line = lineNetwork(lineSprings(beam, U, k2), U, 30, 1.0);
  NetworkLoads loads = noLoads(line);
  loads.free.row(1).setZero();
  loads.free.row(2).setZero();
  loads.free(0, 15) = 0.0;
  Points x = line.points;
  const double imbalance = 1e-14 * E * beam.area;
  EXPECT_EQ(solveNetwork(line, loads, {imbalance}, &x).status, solver::SolveStatus::kConverged);
  Eigen::VectorXd s(29);
  for (int i = 0; i < 29; ++i) s[i] = U - (x(0, i + 1) - x(0, i));
  return s;
}

TEST(BeamStatics, FreeEndsContractInTheLastSpringOnly) {
  const double h = 0.1, U = 32.0 / 29;
  const Eigen::VectorXd s = shortenings(rectangularSection(E, h, h), U, 0.0);
  const double s0 = h * h / (6 * U * U);  // 1.4e-3
  EXPECT_NEAR(s0, 1.4e-3, 0.05e-3);
  EXPECT_NEAR(s[0] / U, s0, 1e-9 * s0);
  EXPECT_NEAR(s[28] / U, s0, 1e-9 * s0);
  EXPECT_LT(s.segment(1, 27).cwiseAbs().maxCoeff() / U, 1e-9 * s0);
}

// Appendix B: r^3 + (1 + c) r^2 - (1 + c) r - 1 = 0 with c = k1/k2, whose root in (-1, 1) is the
// ratio of one spring's shortening to that of the spring before.
TEST(BeamStatics, WithFlexionStiffnessTheContractionDecaysByTheRoot) {
  const double h = 0.1, U = 32.0 / 29;
  const BeamSection beam = rectangularSection(E, h, h);
  for (const double c : {0.5, 1.0, 2.0, 4.0}) {
    const double k2 = E * beam.area / U / (c + 4);
    const Eigen::VectorXd s = shortenings(beam, U, k2);
    const double r = 0.5 * (-(2 + c) + std::sqrt(c * c + 4 * c));
    EXPECT_NEAR(r * r * r + (1 + c) * r * r - (1 + c) * r - 1, 0.0, 1e-14);
    for (int i = 1; i < 3; ++i) EXPECT_NEAR(s[i + 1] / s[i], r, 1e-3) << "c = " << c << ", " << i;
    EXPECT_LT(std::abs(s[12] / s[1]), std::pow(-r, 10)) << "c = " << c;
  }
}

}  // namespace
}  // namespace palpate::springs::beam_statics_test
