// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/skin/two_layer_block.h"

namespace palpate::skin {

/// Least depth > 0 at which a triangle has zero area [m]; infinite if there is none. At the depth
/// d, a triangle's area is 1 + a d + b d^2 times that at rest.
double inversionDepth(const UnitIndentation& unit);

/// Least depth > 0 at which a node initially above the bone reaches it [m]; infinite if there is
/// none.
double boneDepth(const UnitIndentation& unit);

}  // namespace palpate::skin
