// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/profile_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace palpate::skin::profile_fit_test {
namespace {

TwoLayerBlock meshOf(int columns) {
  TwoLayerBlock block;
  block.columns = columns;
  block.rows = columns * 3 / 8;
  block.upper_rows = block.rows / 2;
  return block;
}

// Tables 3.1 and 3.2 are the readings, scaled and rounded: to the nearest hundredth of a millimetre
// but for halves that a digit before was rounded, so 0.006 is let pass.
TEST(MeasuredProfile, RoundsToThePrintedTables) {
  for (int set = 1; set <= kProfileSets; ++set) {
    const MeasuredProfile& profile = measuredProfile(set);
    ASSERT_EQ(profile.printed.size(), profile.radii.size());
    ASSERT_EQ(profile.readings.size(), profile.radii.size());
    for (int k = 0; k < profile.size(); ++k) {
      EXPECT_NEAR(1e3 * profile.depth(k), profile.printed[static_cast<std::size_t>(k)], 0.0051)
          << set << ", " << k;
    }
  }
  EXPECT_EQ(measuredProfile(1).size(), 18);
  EXPECT_EQ(measuredProfile(2).size(), 12);
  EXPECT_THROW(measuredProfile(0), std::out_of_range);
  EXPECT_THROW(measuredProfile(3), std::out_of_range);
}

// By other code, of the source's choice of layer and ratio.
TEST(ProfileFit, ConvergedDepthsAndErrorsOfTheOptimum) {
  struct {
    int columns, set;
    double depth, published, rms, largest;
  } const expected[] = {{16, 1, 1.9581, 0.017825, 0.0756, 0.116},
                        {16, 2, 0.9097, 0.019863, 0.0688, 0.121},
                        {32, 1, 2.2767, 0.014572, 0, 0},
                        {32, 2, 0.9948, 0.017858, 0, 0}};
  for (const auto& e : expected) {
    const UnitIndentation unit = indent(meshOf(e.columns));
    const MeasuredProfile& profile = measuredProfile(e.set);
    const double depth = pinnedDepth(unit, profile);
    const ProfileErrors errors = profileErrors(unit, depth, profile);
    EXPECT_NEAR(1e3 * depth, e.depth, 0.5e-4);
    EXPECT_NEAR(1e3 * errors.published, e.published, 0.5e-6);
    EXPECT_NEAR(surfaceDepth(unit, depth, 0.25e-3), profile.depth(0), 1e-11);
    EXPECT_NEAR(errors.rms * errors.rms, errors.mean_square, 1e-18);
    EXPECT_NEAR(errors.rms, errors.published * std::sqrt(profile.size()), 1e-15);
    if (e.rms == 0.0) continue;
    EXPECT_NEAR(1e3 * errors.rms, e.rms, 0.5e-4);
    EXPECT_NEAR(1e3 * errors.largest, e.largest, 1e-3);  // 0.11549 was rounded twice
  }
}

// The contact slides by more than 0.25 mm, so the first reading is right of it.
TEST(ProfileFit, PlaneStrainIsAnotherModel) {
  TwoLayerBlock block;
  block.idealization = Idealization::kPlaneStrain;
  const UnitIndentation unit = indent(block);
  const MeasuredProfile& profile = measuredProfile(1);
  EXPECT_NEAR(1e3 * profileErrors(unit, pinnedDepth(unit, profile), profile).published, 0.0796,
              0.5e-4);
}

// A point's depth grows with the logarithm of the mesh; that of a patch has a limit.
TEST(ProfileFit, OnlyAPatchHasADepthThatConverges) {
  const double found[] = {1.958, 2.277, 2.566, 2.823};
  int k = 0;
  for (const int columns : {16, 32, 64, 128}) {
    const double depth = pinnedDepth(indent(meshOf(columns)), measuredProfile(1));
    EXPECT_NEAR(1e3 * depth, found[k++], 0.5e-3) << columns;
  }
  double depths[3], forces[3];
  k = 0;
  for (const int columns : {64, 128, 256}) {
    TwoLayerBlock block = meshOf(columns);
    block.patch = 0.1875e-3;  // below the first reading's radius
    const UnitIndentation unit = indent(block);
    depths[k] = pinnedDepth(unit, measuredProfile(1));
    forces[k++] = unit.force;
  }
  EXPECT_LT(std::abs(depths[2] - depths[1]), 0.7 * std::abs(depths[1] - depths[0]));
  EXPECT_LT(std::abs(depths[2] - depths[1]), 0.02 * depths[2]);
  EXPECT_LT(std::abs(forces[2] - forces[1]), 0.7 * std::abs(forces[1] - forces[0]));
}

TEST(ProfileFit, RingsAreReadFromTheirAxis) {
  TwoLayerBlock block;
  block.idealization = Idealization::kAxisymmetric;
  block.diagonals = Diagonals::kAlternating;
  const UnitIndentation unit = indent(block);
  EXPECT_NEAR(surfaceDepth(unit, 1e-3, 0.0), 1e-3, 1e-15);
  EXPECT_EQ(surfaceDepth(unit, 1e-3, 0.006), 0.0);
  EXPECT_EQ(surfaceDepth(unit, 1e-3, 0.008), 0.0);
  double last = 1e-3;
  for (double r = 0.25e-3; r < 4e-3; r += 0.25e-3) {
    const double now = surfaceDepth(unit, 1e-3, r);
    EXPECT_LT(now, last);
    last = now;
  }
}

}  // namespace
}  // namespace palpate::skin::profile_fit_test
