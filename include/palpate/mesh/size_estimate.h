// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/mesh/size_field.h"

namespace palpate::mesh {

/// Estimated number of tetrahedra of mean edge length `edge_length` [m] in `volume` [m^3].
double estimateTets(double volume, double edge_length);

/// Estimated mean edge length of a mesh of tetrahedra of `volume` [m^3] [m].
double edgeLength(double volume);

/// Estimated mesh size of a body by a size field.
struct SizeEstimate {
  double tets = 0.0;            ///< Estimated number of tetrahedra.
  std::vector<double> of_zone;  ///< Number due to each refinement zone.
  std::vector<bool> felt;       ///< Whether each zone has an effect.
  bool complete = true;         ///< False: the count stopped at its limit.
};

/// The integral of estimateTets() over the body within `surface`, which is closed, by boxes that
/// are halved until the size hardly changes in them, or there are a million. The same input gives
/// the same bits. Counting stops above `most` tetrahedra; what is `felt` is not known then.
SizeEstimate estimateTets(const SurfaceMesh& surface, const SizeField& field, double most);

}  // namespace palpate::mesh
