// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/types.h"

namespace palpate::scene {

/// Of a way through `points`, at least one, those that it needs so that no other is farther than
/// `deviation` from the line through them [Douglas and Peucker 1973]; the first and the last are
/// among them, and every 4000th, for the search takes the square of their number.
std::vector<Vec3> wayCorners(const std::vector<Vec3>& points, double deviation);

}  // namespace palpate::scene
