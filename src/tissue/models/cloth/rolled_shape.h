// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/tissue/cloth/cloth_settings.h"

namespace palpate::tissue {

/// Length of the spiral r = radius (1 - loss beta) from beta = 0 to where 1 - loss beta is
/// `left` [m], and the `left` in (0, 1] of a length; without loss a circle, of which `left` is 1.
double spiralLength(const RolledSettings& rolled, double left);
double spiralLeft(const RolledSettings& rolled, double length);

/// Positions of the points X of a flat sheet at z = const, 3 x n [m], rolled along a spiral by
/// their distance in y from the edge. `spacing`: mean distance of neighbours [m].
/// @throws std::invalid_argument, naming key, value and limit, for a sheet that is not flat, layers
/// nearer than gap_least, or an innermost radius below `spacing`.
Points rolledUp(const Points& X, double spacing, const RolledSettings& rolled);

}  // namespace palpate::tissue
