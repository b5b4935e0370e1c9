// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/mesh/volume_mesher.h"

namespace palpate::mesh {

/// $XDG_CACHE_HOME/palpate, else ~/.cache/palpate; "" if neither variable is an absolute path.
std::string defaultCacheDirectory();

/// meshVolume() with a memory: the mesh is kept in a file of `cache_directory`, named by a hash of
/// the surface's bits, the options and the version of the mesher. The same mesh comes back bit for
/// bit. A file that is damaged is made anew. Several processes may share the directory: files
/// appear whole or not at all. A directory that cannot be read or written, or "", only means that
/// nothing is remembered. `hit`, if not null, says whether the mesh came from the cache.
///
/// @throws InputError as meshVolume().
TetMesh meshVolumeCached(const SurfaceMesh& surface, const MeshingOptions& options,
                         const std::string& cache_directory, const MeshingProgress& progress = {},
                         bool* hit = nullptr);

/// The file that meshVolumeCached() uses.
std::string cacheFile(const SurfaceMesh& surface, const MeshingOptions& options,
                      const std::string& cache_directory);

}  // namespace palpate::mesh
