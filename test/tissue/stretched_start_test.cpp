// SPDX-License-Identifier: GPL-3.0-or-later
// Slabs let go ten times as large as they are, which no cycle's iterations can solve: no part of
// them flies off, no step adds energy, and they come back.
#include <gtest/gtest.h>

#include <limits>

#include "liver_slab.h"

namespace palpate::tissue::stretched_start_test {
namespace {

using test::LiverSlab;
constexpr double kStep = 0.002;
constexpr double kRounding = 1e-12;  // [J]

struct Case {
  const char* method;
  const char* element;
  const char* law;
  Eigen::Vector3i cells;
};

class StretchedStart : public testing::TestWithParam<Case> {};

TEST_P(StretchedStart, ComesBackWithoutFlyingApart) {
  LiverSlab slab(GetParam().method, GetParam().cells, GetParam().element);
  slab.law = LiverSlab::liver(GetParam().law, 0.49);
  slab.settings.mass_damping = 60.0;
  slab.settings.stiffness_damping = 0.5 * kStep;
  const auto tissue = slab.make();
  const Points& X = slab.mesh.points;
  const Points x = X + 9.0 * X.cwiseProduct(slab.free);
  tissue->setPositions(0, x, Points::Zero(3, X.cols()));
  const double size = x.colwise().norm().maxCoeff();
  double energy = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 300; ++k) {
    const TissueStep& step = tissue->step({}, kStep);
    const double now = step.kinetic_energy + step.elastic_energy;
    EXPECT_LE(now, energy + kRounding) << k;
    energy = now;
    ASSERT_LT(tissue->positions(0).colwise().norm().maxCoeff(), 5.0 * size) << k;
  }
  EXPECT_LT((tissue->positions(0) - X).colwise().norm().maxCoeff(), 1e-4 * 0.1);
}

INSTANTIATE_TEST_SUITE_P(
    All, StretchedStart,
    testing::Values(Case{"implicit_pcg", "anp", "neo_hookean", {3, 3, 2}},
                    Case{"implicit_direct", "tet4", "neo_hookean", {3, 3, 2}},
                    Case{"lbfgs", "p1p1", "neo_hookean", {3, 3, 2}},
                    Case{"implicit_async", "p1p1", "neo_hookean", {3, 3, 2}},
                    Case{"implicit_pcg", "tet10p", "stable_neo_hookean", {2, 2, 1}}));

}  // namespace
}  // namespace palpate::tissue::stretched_start_test
