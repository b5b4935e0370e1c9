// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/types.h"

namespace palpate::enrichment {

/// Indices of `points` (3 x n), nearest to `contact` first, the smaller index where two are as near
/// [Bounik, Shamsi, Sedaaghi 2020]: equal deformations about different contacts get equal features.
std::vector<int> contactOrder(const Points& points, const Vec3& contact);

/// Columns of `values` (3 x n) in the order `order`, only the first `count` of them, as one vector.
Eigen::VectorXd ordered(const Points& values, const std::vector<int>& order, Eigen::Index count);

}  // namespace palpate::enrichment
