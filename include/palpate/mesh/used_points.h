// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// The surface without the points that no triangle uses; the others keep their order.
SurfaceMesh onlyUsedPoints(SurfaceMesh surface);

}  // namespace palpate::mesh
