// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/distance_grid_cache.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <system_error>

#include "cache_file.h"
#include "palpate/base/content_hash.h"

namespace palpate::mesh {
namespace {

// Version of the grids and of the file format; increase it with each change.
constexpr std::uint64_t kGridVersion = 1;
constexpr char kGridMagic[8] = {'p', 'a', 'l', 'p', 's', 'd', 'f', '\n'};

std::uint64_t gridKey(const SurfaceMesh& surface, const DistanceGridSettings& settings,
                      std::uint64_t seed) {
  ContentHash hash(seed);
  hash.add(kGridVersion);
  hash.add(makerOfGeometry());
  hash.add(static_cast<std::uint64_t>(settings.cells));
  hash.add(&settings.error, sizeof(double));
  hash.add(&settings.memory, sizeof(double));
  hash.add(&settings.margin, sizeof(double));
  hash.add(surface.points.data(), sizeof(double) * surface.points.size());
  hash.add(surface.triangles.data(), sizeof(int) * surface.triangles.size());
  return hash.value();
}

/// All of a grid but the splines and the surface, which the caller has.
struct GridHeader {
  char magic[8];
  std::uint64_t version, checksum, limited;
  std::int64_t cells[3];
  double low[3], spacing, largest_error, rms_error, deepest[3], inscribed_radius;
};

std::uint64_t gridChecksum(GridHeader header, const Eigen::VectorXd& coefficients) {
  header.checksum = 0;
  ContentHash hash(kGridVersion);
  hash.add(&header, sizeof(header));
  hash.add(coefficients.data(), sizeof(double) * coefficients.size());
  return hash.value();
}

GridHeader headerOf(const DistanceGrid& grid) {
  GridHeader header{};
  std::memcpy(header.magic, kGridMagic, sizeof(kGridMagic));
  header.version = kGridVersion;
  header.limited = grid.limited ? 1 : 0;
  for (int axis = 0; axis < 3; ++axis) {
    header.cells[axis] = grid.field.box.cells[axis];
    header.low[axis] = grid.field.box.low[axis];
    header.deepest[axis] = grid.deepest[axis];
  }
  header.spacing = grid.field.box.spacing;
  header.largest_error = grid.largest_error;
  header.rms_error = grid.rms_error;
  header.inscribed_radius = grid.inscribed_radius;
  header.checksum = gridChecksum(header, grid.field.coefficients);
  return header;
}

// Reads a grid without its surface.
std::optional<DistanceGrid> readGrid(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  GridHeader header{};
  if (!file.read(reinterpret_cast<char*>(&header), sizeof(header))) return std::nullopt;
  if (std::memcmp(header.magic, kGridMagic, sizeof(kGridMagic)) != 0 ||
      header.version != kGridVersion) {
    return std::nullopt;
  }
  DistanceGrid grid;
  for (int axis = 0; axis < 3; ++axis) {
    constexpr std::int64_t kMost = 1 << 20;
    if (header.cells[axis] < 1 || header.cells[axis] > kMost) return std::nullopt;
    grid.field.box.cells[axis] = static_cast<int>(header.cells[axis]);
    grid.field.box.low[axis] = header.low[axis];
    grid.deepest[axis] = header.deepest[axis];
  }
  // The counts are valid only if the file has the matching length.
  const Eigen::Index count = SplineGrid::numCoefficients(grid.field.box.cells);
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error || bytes != sizeof(header) + sizeof(double) * static_cast<std::uintmax_t>(count)) {
    return std::nullopt;
  }
  grid.field.coefficients.resize(count);
  file.read(reinterpret_cast<char*>(grid.field.coefficients.data()),
            static_cast<std::streamsize>(sizeof(double) * count));
  if (!file || gridChecksum(header, grid.field.coefficients) != header.checksum)
    return std::nullopt;
  grid.field.box.spacing = header.spacing;
  grid.largest_error = header.largest_error;
  grid.rms_error = header.rms_error;
  grid.limited = header.limited != 0;
  grid.inscribed_radius = header.inscribed_radius;
  return grid;
}

}  // namespace

std::string cacheFile(const SurfaceMesh& surface, const DistanceGridSettings& settings,
                      const std::string& cache_directory) {
  return cachePath(cache_directory, gridKey(surface, settings, 0), gridKey(surface, settings, 1),
                   ".sdf");
}

DistanceGrid distanceGridCached(const SurfaceMesh& surface, const DistanceGridSettings& settings,
                                const std::string& cache_directory, const MeshingProgress& progress,
                                bool* hit) {
  if (hit != nullptr) *hit = false;
  if (cache_directory.empty()) return makeDistanceGrid(surface, settings, progress);
  const std::string path = cacheFile(surface, settings, cache_directory);
  if (std::optional<DistanceGrid> cached = readGrid(path)) {
    if (hit != nullptr) *hit = true;
    if (progress) progress("found in the cache", 1.0);
    cached->surface = surface;
    return *std::move(cached);
  }
  DistanceGrid grid = makeDistanceGrid(surface, settings, progress);
  const GridHeader header = headerOf(grid);
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof(header));
  bytes.append(reinterpret_cast<const char*>(grid.field.coefficients.data()),
               sizeof(double) * static_cast<std::size_t>(grid.field.coefficients.size()));
  writeCacheFile(path, bytes);
  return grid;
}

}  // namespace palpate::mesh
