// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/mesh/distance_grid.h"

namespace palpate::mesh {

/// makeDistanceGrid() with a memory, as meshVolumeCached() has and in the same folder: the same
/// grid comes back bit for bit. `hit`, if not null, says whether it came from the cache.
DistanceGrid distanceGridCached(const SurfaceMesh& surface, const DistanceGridSettings& settings,
                                const std::string& cache_directory,
                                const MeshingProgress& progress = {}, bool* hit = nullptr);

/// The file that distanceGridCached() uses.
std::string cacheFile(const SurfaceMesh& surface, const DistanceGridSettings& settings,
                      const std::string& cache_directory);

}  // namespace palpate::mesh
