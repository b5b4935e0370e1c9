// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace palpate::mesh {

/// What determines the bits of cached geometry apart from its input: rounding() and CGAL's version.
std::string makerOfGeometry();

/// Path in the cache for these two hashes; `ending` with its dot.
std::string cachePath(const std::string& cache_directory, std::uint64_t first, std::uint64_t second,
                      const std::string& ending);

/// Writes atomically, with the folder. Failure is silent: the next start computes again.
void writeCacheFile(const std::string& path, std::string_view bytes);

}  // namespace palpate::mesh
