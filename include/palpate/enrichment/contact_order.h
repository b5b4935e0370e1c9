// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/types.h"

namespace palpate::enrichment {

/// Indices of `points` (3 x n) by distance from `contact`, ties by index [Bounik, Shamsi, Sedaaghi
/// 2020]. Equal deformations about different contacts thus have equal features.
std::vector<int> contactOrder(const Points& points, const Vec3& contact);

/// The first `count` columns of `values` (3 x n) in the order `order`, stacked as a vector.
Eigen::VectorXd ordered(const Points& values, const std::vector<int>& order, Eigen::Index count);

}  // namespace palpate::enrichment
