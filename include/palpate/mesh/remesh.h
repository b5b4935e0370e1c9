// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// Near-uniform triangles of about `edge_length` [m] on the closed surface of `surface`
/// (isotropic remeshing, Botsch and Kobbelt 2004, by CGAL).
SurfaceMesh remesh(const SurfaceMesh& surface, double edge_length, int iterations);

/// The same, with edges along those of `surface` at which the normals differ by over 60 degrees,
/// and points where such edges meet.
SurfaceMesh remeshWithEdges(const SurfaceMesh& surface, double edge_length, int iterations);

}  // namespace palpate::mesh
