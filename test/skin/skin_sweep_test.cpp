// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "palpate/base/error.h"

namespace palpate::skin::skin_sweep_test {
namespace {

TEST(SkinSweep, RatiosAreThoseOfTheTables) {
  EXPECT_EQ(geometricRatios(), (std::vector<double>{1, 3, 7, 15, 31, 63, 127, 255, 511}));
  EXPECT_EQ(linearRatios(), (std::vector<double>{7, 8, 9, 10, 11, 12, 13, 14, 15}));
}

// Table 3.5: a ratio of 10 alone, fractions 1/6 to 5/6; three of them are of two corrections that
// other fractions came before.
TEST(SkinSweep, GoesThroughAllLayers) {
  const auto points = sweep(TwoLayerBlock(), {10.0}, DepthProtocol::kConverged);
  ASSERT_EQ(points.size(), 5u);
  const double printed[5][2] = {{0.027407, 0.018149},
                                {0.015165, 0.02335},
                                {0.017824, 0.019866},
                                {0.031569, 0.011785},
                                {0.054288, 0.008107}};
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_EQ(points[k].upper_rows, static_cast<int>(k) + 1);
    for (std::size_t set = 0; set < 2; ++set) {
      EXPECT_NEAR(1e3 * points[k].sets[set].errors.published, printed[k][set], 1e-4);
      EXPECT_GT(points[k].sets[set].force, 0.0);
    }
  }
  const auto soft = sweep(TwoLayerBlock(), {31.0}, DepthProtocol::kConverged);
  EXPECT_LT(soft[4].bone_depth, soft[4].sets[0].depth);  // the source's reason against 5/6
}

// What other code found: the published choice, 3 rows and 10, is not the least of its own data.
TEST(SkinSweep, TheLeastOfTheLargerErrorIsElsewhere) {
  std::vector<double> ratios;
  for (int k = 70; k <= 160; ++k) ratios.push_back(0.1 * k);
  const auto points = sweep(TwoLayerBlock(), ratios, DepthProtocol::kConverged);
  const SweepPoint& best = optimum(points, {Criterion::Kind::kLargest});
  EXPECT_EQ(best.upper_rows, 4);
  EXPECT_NEAR(best.stiffness_ratio, 15.0, 0.5);
  EXPECT_NEAR(1e3 * best.sets[0].errors.published, 0.0191, 1e-4);
  EXPECT_NEAR(1e3 * best.sets[1].errors.published, 0.0190, 1e-4);
}

SweepPoint pointOf(double a, double b) {
  SweepPoint point{};
  point.sets[0].errors.published = a;
  point.sets[1].errors.published = b;
  return point;
}

TEST(SkinSweep, CriteriaChooseWhatTheySay) {
  using Kind = Criterion::Kind;
  const std::vector<SweepPoint> points = {pointOf(1, 6), pointOf(4, 4), pointOf(7, 0.5)};
  EXPECT_EQ(optimum(points, {Kind::kLargest}).sets[0].errors.published, 4);
  EXPECT_EQ(optimum(points, {Kind::kSum}).sets[0].errors.published, 1);
  EXPECT_EQ(optimum(points, {Kind::kWeighted, 0.0}).sets[0].errors.published, 7);
  EXPECT_EQ(optimum(points, {Kind::kWeighted, 1.0}).sets[0].errors.published, 1);
  EXPECT_EQ(acceptable(points, {Kind::kLargest}, 1.0).size(), 1u);
  EXPECT_EQ(acceptable(points, {Kind::kLargest}, 1.5).size(), 2u);
  EXPECT_EQ(acceptable(points, {Kind::kLargest}, 2.0).size(), 3u);
  EXPECT_THROW(optimum({}, {Kind::kSum}), std::invalid_argument);
}

TEST(SkinSweep, RefusesARatioOfNothing) {
  EXPECT_THROW(sweep(TwoLayerBlock(), {0.0}, DepthProtocol::kConverged), InputError);
}

}  // namespace
}  // namespace palpate::skin::skin_sweep_test
