// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::fem {

/// Least det F found in a quadratic tetrahedron, with `F` at the points of Tetrahedron<10>. F is
/// linear for edges straight at rest, so det F is cubic and may be negative between points with det
/// F = 1. Evaluated on a grid of sixths, or only at the corners for small differences. A proof of
/// positivity needs more [Johnen, Remacle, Geuzaine 2013, sec. 3]; a value found here does occur.
double jacobianWithin(const Mat3 (&F)[4]);

}  // namespace palpate::fem
