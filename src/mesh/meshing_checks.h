// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/mesh/volume_mesher.h"

namespace palpate::mesh {

/// @throws InputError that names the edge length, or its coarsest.
[[noreturn]] void refuseEdgeLength(const MeshingOptions& options, const std::string& reason);

/// Refuses what cannot be meshed, whatever it is that bounds the body. @throws InputError
void checkMeshing(const SurfaceMesh& surface, const MeshingOptions& options);

/// About how many tetrahedra each of the bodies becomes.
/// @throws InputError if they are more than kMaxTets, or a place of the size field makes nothing
/// finer.
std::vector<double> expectTets(const std::vector<SurfaceMesh>& bodies,
                               const MeshingOptions& options);

}  // namespace palpate::mesh
