// SPDX-License-Identifier: GPL-3.0-or-later
#include "cache_file.h"

#include <CGAL/version.h>

#include <cstdio>
#include <filesystem>
#include <system_error>

#include "palpate/base/atomic_file.h"
#include "palpate/base/error.h"
#include "palpate/base/rounding.h"

namespace palpate::mesh {

namespace fs = std::filesystem;

// CGAL improves tetrahedra by comparing angles that the C library computes.
std::string makerOfGeometry() {
  return "CGAL " + std::to_string(CGAL_VERSION_NR) + ", " + rounding();
}

std::string cachePath(const std::string& cache_directory, std::uint64_t first, std::uint64_t second,
                      const std::string& ending) {
  char name[40];
  std::snprintf(name, sizeof(name), "%016llx%016llx", static_cast<unsigned long long>(first),
                static_cast<unsigned long long>(second));
  return (fs::path(cache_directory) / (name + ending)).string();
}

void writeCacheFile(const std::string& path, std::string_view bytes) {
  std::error_code ignored;
  fs::create_directories(fs::path(path).parent_path(), ignored);
  try {
    writeFileAtomically(path, bytes);
  } catch (const InputError&) {
    return;
  }
}

}  // namespace palpate::mesh
