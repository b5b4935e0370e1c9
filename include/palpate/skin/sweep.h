// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "palpate/skin/profile_fit.h"

namespace palpate::skin {

/// How depths are found.
enum class DepthProtocol {
  kPublished,  ///< Two corrections at each point of a sweep, from the depth of the point before.
  kConverged   ///< pinnedDepth(), whatever came before.
};

/// A set of readings beside a block.
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

/// All layers of `block`, from 1 row to all but one, and for each all ratios in their order.
/// @throws InputError as checkBlock(), and for a ratio that is not > 0.
std::vector<SweepPoint> sweep(const TwoLayerBlock& block, const std::vector<double>& ratios,
                              DepthProtocol protocol);

/// One number for the two errors a and b of a point, by ProfileErrors::published.
struct Criterion {
  enum class Kind { kLargest, kSum, kWeighted } kind = Kind::kLargest;
  double weight = 0.5;  ///< Of set 1; 1 - weight of set 2. Only kWeighted reads it.

  double operator()(const SweepPoint& point) const;
};

/// The point with the least criterion; of equals the first.
/// @throws std::invalid_argument if there are no points.
const SweepPoint& optimum(const std::vector<SweepPoint>& points, const Criterion& criterion);

/// Those with at most `times` the least criterion, in their order.
std::vector<SweepPoint> acceptable(const std::vector<SweepPoint>& points,
                                   const Criterion& criterion, double times);

}  // namespace palpate::skin
