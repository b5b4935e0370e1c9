// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/mesh/surface_mesh.h"

namespace palpate::organs {

// Shapes of makeOrgan() at any position, in triangles of about `edge_length` [m].
mesh::SurfaceMesh makeLiver(double edge_length);
mesh::SurfaceMesh makeKidney(double edge_length);
mesh::SurfaceMesh makeGallbladder(double edge_length);
mesh::SurfaceMesh makeHollowGallbladder(double edge_length);
mesh::SurfaceMesh makeSlab(double edge_length);

}  // namespace palpate::organs
