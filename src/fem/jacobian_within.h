// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::fem {

/// Smallest det F that is found in a quadratic tetrahedron, of which `F` is at the points of
/// Tetrahedron<10>. F is linear in the barycentric coordinates where the edges are straight at
/// rest, so that det F is cubic and can go through zero between points where it is 1: it is taken
/// on a grid of sixths, or only at the corners where these differ little. Whether it is positive
/// everywhere needs more [Johnen, Remacle, Geuzaine 2013, sec. 3]; what is found is there.
double jacobianWithin(const Mat3 (&F)[4]);

}  // namespace palpate::fem
