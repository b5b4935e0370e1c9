// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/types.h"

namespace palpate::scene {

/// Simplifies a polyline of at least one point within `deviation` [Douglas, Peucker 1973]. Keeps
/// the first, the last and every 4000th point, since the search is quadratic in their number.
std::vector<Vec3> wayCorners(const std::vector<Vec3>& points, double deviation);

}  // namespace palpate::scene
