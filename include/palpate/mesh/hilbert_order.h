// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/types.h"

namespace palpate::mesh {

/// The numbers of `points`, 3 x n, in the order of Hilbert's curve through their bounding box, in
/// which those that follow one another are neighbours.
std::vector<int> hilbertOrder(const Points& points);

}  // namespace palpate::mesh
