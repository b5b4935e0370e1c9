// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

// The shapes of makeOrgan(), anywhere in space, of triangles of about `edge_length` [m].
SurfaceMesh makeLiver(double edge_length);
SurfaceMesh makeKidney(double edge_length);
SurfaceMesh makeGallbladder(double edge_length);
SurfaceMesh makeSlab(double edge_length);

}  // namespace palpate::mesh
