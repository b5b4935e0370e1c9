// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/skin/measured_profile.h"
#include "palpate/skin/two_layer_block.h"

namespace palpate::skin {

/// Depth of the surface below its rest at `radius` left of the middle, or at that ring radius, for
/// a press by `depth` [m]; linear between the moved top nodes.
double surfaceDepth(const UnitIndentation& unit, double depth, double radius);

/// Norms of n differences e between surface and readings.
struct ProfileErrors {
  double published = 0.0;    ///< sqrt(sum e^2)/n, as in the source's tables [m]
  double mean_square = 0.0;  ///< sum e^2/n, as in its (3.4) [m^2]
  double rms = 0.0;          ///< [m]
  double largest = 0.0;      ///< [m]
};

ProfileErrors profileErrors(const UnitIndentation& unit, double depth,
                            const MeasuredProfile& profile);

/// `depth` minus the surface's excess depth at the first radius, 0.25 mm. There are no readings
/// closer to the load, so the curve is fitted at this radius.
double correctedDepth(const UnitIndentation& unit, double depth, const MeasuredProfile& profile);

constexpr int kPublishedCorrections = 2;  ///< For each figure of the source's tables

/// Corrects from profile.start_depth until the first radius fits within `within` [m].
/// @throws std::domain_error after 1000 corrections.
double pinnedDepth(const UnitIndentation& unit, const MeasuredProfile& profile,
                   double within = 1e-12);

}  // namespace palpate::skin
