// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/mesh_cache.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <variant>

#include "cache_file.h"
#include "palpate/base/content_hash.h"

namespace palpate::mesh {
namespace {

namespace fs = std::filesystem;

// Version of the mesher and of the file format; increase it with each change.
constexpr std::uint64_t kMeshVersion = 1;
constexpr char kMeshMagic[8] = {'p', 'a', 'l', 'p', 't', 'e', 't', '\n'};

struct AddWhere {
  ContentHash* hash;

  void add(double x) const { hash->add(&x, sizeof(x)); }
  void add(const Vec3& p) const { hash->add(p.data(), 3 * sizeof(double)); }
  void operator()(const Polyline& line) const {
    hash->add(line.points.size());
    for (const Vec3& p : line.points) add(p);
  }
  void operator()(const Region& region) const {
    hash->add(region.index());
    std::visit(*this, region);
  }
  void operator()(const OwnSurface&) const {}
  void operator()(const PlaneRegion& plane) const {
    hash->add(static_cast<std::uint64_t>(plane.axis));
    add(plane.at);
    add(plane.tolerance);
  }
  void operator()(const BoxRegion& box) const {
    add(box.min);
    add(box.max);
  }
  void operator()(const SphereRegion& sphere) const {
    add(sphere.center);
    add(sphere.radius);
  }
};

void addTo(ContentHash* hash, const RefinementZone& place) {
  const AddWhere to{hash};
  to.add(place.finest);
  to.add(place.growth);
  to.add(place.radius);
  hash->add(place.where.index());
  std::visit(to, place.where);
}

std::uint64_t meshKey(const SurfaceMesh& surface, const MeshingOptions& options,
                      std::uint64_t seed) {
  ContentHash hash(seed);
  hash.add(kMeshVersion);
  hash.add(makerOfGeometry());
  hash.add(&options.edge_length.coarsest, sizeof(double));
  hash.add(static_cast<std::uint64_t>(options.sharp_edges));
  hash.add(surface.points.data(), sizeof(double) * surface.points.size());
  hash.add(surface.triangles.data(), sizeof(int) * surface.triangles.size());
  for (const RefinementZone& place : options.edge_length.near) addTo(&hash, place);
  return hash.value();
}

struct MeshHeader {
  char magic[8];
  std::uint64_t version, points, tets, checksum;
};

std::uint64_t meshChecksum(const TetMesh& mesh) {
  ContentHash hash(kMeshVersion);
  hash.add(mesh.points.data(), sizeof(double) * mesh.points.size());
  hash.add(mesh.tets.data(), sizeof(int) * mesh.tets.size());
  return hash.value();
}

std::optional<TetMesh> readMesh(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  MeshHeader header{};
  if (!file.read(reinterpret_cast<char*>(&header), sizeof(header))) return std::nullopt;
  if (std::memcmp(header.magic, kMeshMagic, sizeof(kMeshMagic)) != 0 ||
      header.version != kMeshVersion) {
    return std::nullopt;
  }
  // The counts are valid only if the file has the matching length.
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(path, error);
  constexpr std::uint64_t kMost = std::uint64_t{1} << 31;
  if (error || header.points >= kMost || header.tets >= kMost ||
      bytes !=
          sizeof(header) + 3 * sizeof(double) * header.points + 4 * sizeof(int) * header.tets) {
    return std::nullopt;
  }
  TetMesh mesh;
  mesh.points.resize(3, static_cast<Eigen::Index>(header.points));
  mesh.tets.resize(4, static_cast<Eigen::Index>(header.tets));
  file.read(reinterpret_cast<char*>(mesh.points.data()),
            static_cast<std::streamsize>(sizeof(double) * mesh.points.size()));
  file.read(reinterpret_cast<char*>(mesh.tets.data()),
            static_cast<std::streamsize>(sizeof(int) * mesh.tets.size()));
  if (!file || meshChecksum(mesh) != header.checksum) return std::nullopt;
  return mesh;
}

void writeMesh(const fs::path& path, const TetMesh& mesh) {
  MeshHeader header{};
  std::memcpy(header.magic, kMeshMagic, sizeof(kMeshMagic));
  header.version = kMeshVersion;
  header.points = static_cast<std::uint64_t>(mesh.numPoints());
  header.tets = static_cast<std::uint64_t>(mesh.numTets());
  header.checksum = meshChecksum(mesh);
  std::string bytes;
  bytes.append(reinterpret_cast<const char*>(&header), sizeof(header));
  bytes.append(reinterpret_cast<const char*>(mesh.points.data()),
               sizeof(double) * static_cast<std::size_t>(mesh.points.size()));
  bytes.append(reinterpret_cast<const char*>(mesh.tets.data()),
               sizeof(int) * static_cast<std::size_t>(mesh.tets.size()));
  writeCacheFile(path, bytes);
}

}  // namespace

std::string defaultCacheDirectory() {
  const auto absolute = [](const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && value[0] == '/' ? std::string(value) : std::string();
  };
  const std::string xdg = absolute("XDG_CACHE_HOME");
  if (!xdg.empty()) return xdg + "/palpate";
  const std::string home = absolute("HOME");
  return home.empty() ? "" : home + "/.cache/palpate";
}

std::string cacheFile(const SurfaceMesh& surface, const MeshingOptions& options,
                      const std::string& cache_directory) {
  return cachePath(cache_directory, meshKey(surface, options, 0), meshKey(surface, options, 1),
                   ".tet");
}

TetMesh meshVolumeCached(const SurfaceMesh& surface, const MeshingOptions& options,
                         const std::string& cache_directory, const MeshingProgress& progress,
                         bool* hit) {
  if (hit != nullptr) *hit = false;
  if (cache_directory.empty()) return meshVolume(surface, options, progress);
  const fs::path path = cacheFile(surface, options, cache_directory);
  if (std::optional<TetMesh> cached = readMesh(path)) {
    if (hit != nullptr) *hit = true;
    if (progress) progress("found in the cache", 1.0);
    return *std::move(cached);
  }
  TetMesh mesh = meshVolume(surface, options, progress);
  writeMesh(path, mesh);
  return mesh;
}

}  // namespace palpate::mesh
