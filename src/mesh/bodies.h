// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// Winding number of a closed surface about `p`: 1 inside, 0 outside [Van Oosterom, Strackee 1983,
/// eq. 8, for the solid angle of a triangle].
double windingNumber(const SurfaceMesh& surface, const Vec3& p);

/// Separate bodies of a closed surface, each with its cavities, in the order of their first
/// triangles.
std::vector<SurfaceMesh> splitBodies(const SurfaceMesh& surface);

}  // namespace palpate::mesh
