// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/instrument/geometry.h"

namespace palpate::instrument {

/// The collision shape of a convex, closed, outward oriented surface [m] (see mesh::convexHull).
/// Every plane supports the surface: rounding in the normal of a needle triangle cannot make it cut
/// a corner off.
/// @throws std::invalid_argument if there is no triangle, a coordinate is not finite, or a corner
/// lies beyond the plane of a triangle by more than 1e-6 of the surface's extent.
ConvexHull makeConvexHull(const mesh::SurfaceMesh& surface);

}  // namespace palpate::instrument
