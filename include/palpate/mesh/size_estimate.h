// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/size_field.h"

namespace palpate::mesh {

/// About how many tetrahedra of mean edge length `edge_length` [m] fill `volume` [m^3].
double estimateTets(double volume, double edge_length);

/// Of a tetrahedron of `volume` [m^3]: the edge length [m] that a mesh of such ones has on average.
double edgeLength(double volume);

/// What a size field makes of a body.
struct SizeEstimate {
  double tets = 0.0;            ///< About so many tetrahedra.
  std::vector<double> of_zone;  ///< Those of them that each place asks for.
  std::vector<bool> felt;       ///< Whether each place makes something finer than the coarsest.
  bool complete = true;         ///< False: counting stopped, there are more than `tets`.
};

/// The integral of estimateTets() over the body within `surface`, which is closed, by boxes that
/// are halved until the size hardly changes in them, or there are a million. The same input gives
/// the same bits. Counting stops above `most` tetrahedra; what is `felt` is not known then.
SizeEstimate estimateTets(const SurfaceMesh& surface, const SizeField& field, double most);

}  // namespace palpate::mesh
