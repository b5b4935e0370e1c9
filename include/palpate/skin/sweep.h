// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "palpate/skin/profile_fit.h"

namespace palpate::skin {

/// Determination of the depth.
enum class DepthProtocol {
  kPublished,  ///< Two corrections at each point of a sweep, from the depth of the previous point.
  kConverged   ///< pinnedDepth(), independent of previous points.
};

/// Fit of a block to a set of readings.
struct SetFit {
  double depth;  ///< Of the contact [m]
  ProfileErrors errors;
  double force;  ///< [N]
};

struct SweepPoint {
  int upper_rows;
  double stiffness_ratio;
  std::array<SetFit, kProfileSets> sets;
  double inversion_depth, bone_depth;  ///< See limits.h [m].
};

/// 1, 3, 7, ..., 511: 2^k - 1.
std::vector<double> geometricRatios();
/// 7, 8, ..., 15.
std::vector<double> linearRatios();

/// All layers of `block`, from 1 row to all but one, each with all ratios in order.
/// @throws InputError as checkBlock(), and for a ratio not > 0.
std::vector<SweepPoint> sweep(const TwoLayerBlock& block, const std::vector<double>& ratios,
                              DepthProtocol protocol);

/// Combines the errors a and b of a point, by ProfileErrors::published.
struct Criterion {
  enum class Kind { kLargest, kSum, kWeighted } kind = Kind::kLargest;
  double weight = 0.5;  ///< Of set 1; 1 - weight for set 2. For kWeighted only.

  double operator()(const SweepPoint& point) const;
};

/// Point with the least criterion, the first among equals. @throws std::invalid_argument without
/// points.
const SweepPoint& optimum(const std::vector<SweepPoint>& points, const Criterion& criterion);

/// Points with at most `times` the least criterion, in order.
std::vector<SweepPoint> acceptable(const std::vector<SweepPoint>& points,
                                   const Criterion& criterion, double times);

}  // namespace palpate::skin
