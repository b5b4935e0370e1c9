// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/instrument/geometry.h"

namespace palpate::instrument {

/// Collision shape of a convex, closed, outward oriented surface [m] (see mesh::convexHull). Each
/// plane is moved to support the surface, so rounded normals of thin triangles cut off no corner.
/// @throws std::invalid_argument without triangles, for a non-finite coordinate, or a corner beyond
/// a triangle's plane by more than 1e-6 of the surface's extent.
ConvexHull makeConvexHull(const mesh::SurfaceMesh& surface);

}  // namespace palpate::instrument
