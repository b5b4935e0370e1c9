// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// The convex hull of `points` (3 x n [m]): closed, outward oriented, its corners among `points`.
/// @throws std::invalid_argument if a point is not finite, or if the points have no volume: fewer
/// than four, all in a plane, or thinner than rounding (volume under 1e-12 of their extent cubed).
SurfaceMesh convexHull(const Points& points);

}  // namespace palpate::mesh
