// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/mesh/volume_mesher.h"

namespace palpate::mesh {

/// @throws InputError naming the edge length, or its coarsest value.
[[noreturn]] void refuseEdgeLength(const MeshingOptions& options, const std::string& reason);

/// Checks that apply to every body. @throws InputError
void checkMeshing(const SurfaceMesh& surface, const MeshingOptions& options);

/// Estimated number of tetrahedra of each body.
/// @throws InputError beyond kMaxTets, or for a refinement zone without effect.
std::vector<double> expectTets(const std::vector<SurfaceMesh>& bodies,
                               const MeshingOptions& options);

}  // namespace palpate::mesh
