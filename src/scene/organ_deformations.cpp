// SPDX-License-Identifier: GPL-3.0-or-later
#include "organ_deformations.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "palpate/base/error.h"
#include "palpate/base/resource.h"
#include "palpate/base/rounding.h"
#include "palpate/enrichment/database_folder.h"
#include "palpate/mesh/mesh_cache.h"
#include "palpate/scene/pressed_organ.h"
#include "palpate/solver/blas_rounding.h"

namespace palpate::scene {
namespace {

namespace fs = std::filesystem;

/// Folder of a database: in the cache, or without a writable cache a temporary one that is removed.
/// The name is a hash of everything that determines the samples.
class Workplace {
 public:
  explicit Workplace(const enrichment::PressedSurfaces& surfaces) {
    char name[32];
    const auto mark = enrichment::databaseMark(surfaces.coarse, surfaces.fine, surfaces.made_by);
    std::snprintf(name, sizeof name, "presses_%016llx", static_cast<unsigned long long>(mark));
    const std::string cache = mesh::defaultCacheDirectory();
    std::error_code error;
    if (!cache.empty()) fs::create_directories(fs::path(cache) / name, error);
    passing_ = cache.empty() || error || ::access((fs::path(cache) / name).c_str(), W_OK) != 0;
    folder_ = passing_ ? fs::temp_directory_path() /
                             ("palpate_" + std::to_string(::getpid()) + "_" + name)
                       : fs::path(cache) / name;
  }
  ~Workplace() {
    std::error_code error;
    if (passing_) fs::remove_all(folder_, error);
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  std::string folder() const { return folder_.string(); }

 private:
  fs::path folder_;
  bool passing_ = false;
};

void warnOfUnsolved(const std::string& organ, int unsolved, const std::string& folder,
                    std::vector<std::string>* warnings) {
  if (unsolved == 0 || !warnings) return;
  warnings->push_back("organ " + organ + ": " + std::to_string(unsolved) +
                      " presses were not solved and teach nothing, in " + folder);
}

}  // namespace

enrichment::DeformationDatabase organDeformations(const Scene& scene, int index,
                                                  const Progress& progress,
                                                  std::vector<std::string>* warnings) {
  const OrganConfig& organ = scene.organs[static_cast<std::size_t>(index)];
  const tissue::EnrichedSettings& enriched = organ.enriched;
  const std::string key = "organs[" + std::to_string(index) + "].enriched.";
  int unsolved = 0;
  enrichment::DeformationDatabase database;
  if (!enriched.database.empty()) {
    std::string folder;
    try {
      folder = resolveResource(enriched.database, fs::path(scene.file).parent_path().string());
    } catch (const std::invalid_argument& error) {
      throw InputError(scene.file, key + "database", enriched.database, error.what());
    }
    database = enrichment::readDatabase(folder, &unsolved);
    warnOfUnsolved(organ.name, unsolved, folder, warnings);
  } else {
    PressedOrgan pressed;
    try {
      pressed = describePresses(scene, index, describeOrgan(scene, index, progress, warnings),
                                enriched.plan, progress);
    } catch (const std::invalid_argument& error) {
      throw InputError(scene.file, key + "triangles", std::to_string(enriched.plan.triangles),
                       error.what());
    }
    pressed.surfaces.made_by += "; rounding of " + rounding() + ", " + solver::blasRounding();
    const Workplace place(pressed.surfaces);
    const int samples = enriched.detail == "none" ? 0 : enriched.plan.samples;
    enrichment::SampleMaker maker(place.folder(), pressed.surfaces, samples);
    maker.run(scene.solver.threads, progress);
    database = enrichment::readDatabase(place.folder(), &unsolved, samples);
    warnOfUnsolved(organ.name, unsolved, place.folder(), warnings);
  }
  if (database.samples.empty() && enriched.detail != "none") {
    const bool made = enriched.database.empty();
    throw InputError(scene.file, key + (made ? "force" : "database"),
                     made ? std::to_string(enriched.plan.press.force) : enriched.database,
                     made ? "no press of this size was solved; must be smaller"
                          : "has no press that was solved; must be a folder that has some");
  }
  return database;
}

}  // namespace palpate::scene
