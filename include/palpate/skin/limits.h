// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/skin/two_layer_block.h"

namespace palpate::skin {

/// The least depth > 0 at which a triangle has no area left [m]; infinite if none ever does. Of the
/// block pressed by depth d a triangle has the area 1 + a d + b d^2 times that at rest.
double inversionDepth(const UnitIndentation& unit);

/// The least depth > 0 at which a node is at the bone, where it was above it at rest [m]; infinite
/// if none ever is.
double boneDepth(const UnitIndentation& unit);

}  // namespace palpate::skin
