// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/fitted_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "palpate/springs/network_statics.h"
#include "palpate/springs/step_bound.h"
#include "palpate/springs/structured_springs.h"
#include "support/random.h"

namespace palpate::springs::fitted_line_test {
namespace {

constexpr double E = 1.0e7, h = 0.1;
const BeamSection kBeam = rectangularSection(E, h, h);

Eigen::VectorXd places(int n, double spread) {
  test::Random random;
  Eigen::VectorXd x(n);
  for (int i = 0; i < n; ++i) {
    x[i] = i + (i > 0 && i < n - 1 ? random.uniform(-spread, spread) : 0.0);
  }
  return x;
}

const ConstraintFamily& family(const std::vector<ConstraintFamily>& all, const std::string& name) {
  for (const ConstraintFamily& f : all) {
    if (f.name == name) return f;
  }
  throw std::invalid_argument("no family " + name);
}

TEST(FittedLine, EvenlySpacedMassesHaveTheStructuredSpringsInside) {
  const int n = 121;
  const LineFit fit = fitLine(kBeam, places(n, 0.0), 1.0);
  EXPECT_EQ(fit.network.springs.size(), 2U * n - 3U);
  const LineSprings regular = lineSprings(kBeam, 1.0);
  // Ends cannot bend as the inside does. What they change decays by exp(-0.12) a mass or faster:
  // with equal weights the least squares of 14 cos t - 2 (bending) and 2 cos t - 2 (tension) have a
  // root there.
  for (const Spring& s : fit.network.springs) {
    if (s.a < n / 2 - 3 || s.a > n / 2 + 3) continue;
    const StencilSpring& expected =
        s.kind == SpringKind::kStructural ? regular.structural : regular.flexion;
    EXPECT_NEAR(s.preload, expected.preload, 0.01 * std::abs(expected.preload)) << s.a;
  }
  double stretch = 0.0, count = 0.0;  // k1 + 4 k2 across the middle (5.26)
  for (const Spring& s : fit.network.springs) {
    if (s.a < n / 2 - 3 || s.a > n / 2 + 3) continue;
    stretch += s.stiffness * s.length * s.length;
    count += s.kind == SpringKind::kStructural;
  }
  EXPECT_NEAR(stretch / count, E * kBeam.area, 0.01 * E * kBeam.area);
}

TEST(FittedLine, ForcesBalanceAndResidualsAreThoseOfTheSprings) {
  const LineFit fit = fitLine(kBeam, places(30, 0.25), 2.0);
  EXPECT_NO_THROW(checkNetwork(fit.network));
  EXPECT_NEAR(fit.network.masses.sum(), 2.0 * 29.0, 1e-12);
  const Points forces = networkForces(fit.network, fit.network.points);
  const double P = 4 * E * kBeam.second_moment;
  EXPECT_LT(forces.cwiseAbs().maxCoeff(), 1e-11 * P);
  EXPECT_LT(family(fit.preload, "balance").worst, 1e-11);
  // (6.15) of mass 7, by hand.
  double sum = 0.0;
  for (const Spring& s : fit.network.springs) {
    if (s.a == 7 || s.b == 7) sum += s.preload * std::pow(s.length, 3);
  }
  const double V = fit.network.points(0, 8) - fit.network.points(0, 6);
  const double B48 = 12 * E * kBeam.second_moment * V;
  EXPECT_LE(std::abs(sum / B48 + 1.0), family(fit.preload, "bending").worst + 1e-12);
  EXPECT_GT(family(fit.preload, "bending").worst, 0.0);
  for (const char* name : {"stretch", "evenness"}) {
    EXPECT_GE(family(fit.stiffness, name).worst, family(fit.stiffness, name).rms) << name;
  }
}

TEST(FittedLine, AStepBoundsTheStiffness) {
  const Eigen::VectorXd x = places(30, 0.2);
  const double step = 5e-3;
  const LineFit fit = fitLine(kBeam, x, 2.0, {}, {step});
  const Eigen::VectorXd bound = largestStiffness(fit.network.springs, fit.network.masses, step);
  int at_bound = 0;
  for (std::size_t i = 0; i < fit.network.springs.size(); ++i) {
    const double k = fit.network.springs[i].stiffness, M = bound[static_cast<Eigen::Index>(i)];
    EXPECT_GE(k, 0.0);
    EXPECT_LE(k, M);
    at_bound += k == M;
  }
  EXPECT_GT(at_bound, 0);
}

TEST(FittedLine, RefusesPlacesThatDoNotAscend) {
  EXPECT_THROW(fitLine(kBeam, Eigen::Vector2d(0, 1), 1.0), std::invalid_argument);
  EXPECT_THROW(fitLine(kBeam, Eigen::Vector3d(0, 1, 1), 1.0), std::invalid_argument);
  EXPECT_THROW(fitLine(kBeam, Eigen::Vector3d(0, 1, 2), 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace palpate::springs::fitted_line_test
