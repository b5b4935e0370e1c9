// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/skin/measured_profile.h"
#include "palpate/skin/two_layer_block.h"

namespace palpate::skin {

/// How far the surface is below its rest to the left of the middle by `radius`, or at that radius
/// of rings, where the block is pressed by `depth` [m]: linear between the top nodes where they
/// have moved to.
double surfaceDepth(const UnitIndentation& unit, double depth, double radius);

/// Of n differences e between surface and readings.
struct ProfileErrors {
  double published = 0.0;    ///< sqrt(sum e^2)/n, what the source's tables have [m]
  double mean_square = 0.0;  ///< sum e^2/n, what its (3.4) says [m^2]
  double rms = 0.0;          ///< [m]
  double largest = 0.0;      ///< [m]
};

ProfileErrors profileErrors(const UnitIndentation& unit, double depth,
                            const MeasuredProfile& profile);

/// `depth` less what the surface is too deep at the first radius, 0.25 mm: nothing was read nearer
/// to the load, so the curve is pinned there.
double correctedDepth(const UnitIndentation& unit, double depth, const MeasuredProfile& profile);

constexpr int kPublishedCorrections = 2;  ///< Of the depth, for each figure of the source's tables

/// Corrects from profile.start_depth until the surface is there within `within` [m].
/// @throws std::domain_error if 1000 corrections do not do.
double pinnedDepth(const UnitIndentation& unit, const MeasuredProfile& profile,
                   double within = 1e-12);

}  // namespace palpate::skin
