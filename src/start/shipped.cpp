// SPDX-License-Identifier: GPL-3.0-or-later
#include "shipped.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/base/resource.h"

namespace palpate::start {
namespace {

namespace fs = std::filesystem;

constexpr char kVariable[] = "PALPATE_SHARE";

bool hasScenes(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "config" / "scenes", ignored);
}

/// Names without their ending of the files in a folder that have it, sorted.
std::vector<std::string> namesIn(const fs::path& folder, const std::string& ending) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() == ending) names.push_back(it->path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path scenesFolder() { return fs::path(shareFolder()) / "config" / "scenes"; }

std::string firstWord(const std::string& name) { return name.substr(0, name.find('_')); }

}  // namespace

std::string shareFolder() {
  if (const char* told = std::getenv(kVariable)) {
    if (hasScenes(told)) return told;
    throw InputError("environment", kVariable, told, "must be a folder that has config/scenes");
  }
  std::error_code ignored;
  const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  const fs::path installed[] = {folder.parent_path(), folder.parent_path().parent_path()};
  for (const fs::path& prefix : installed) {
    const fs::path share = prefix / "share" / "palpate";
    if (hasScenes(share)) return share.string();
  }
  if (hasScenes(PALPATE_SOURCE_DIR)) return PALPATE_SOURCE_DIR;
  throw InputError("environment", kVariable, "",
                   "must be the folder that has palpate's config/scenes: there is none in " +
                       (installed[0] / "share" / "palpate").string() + ", " +
                       (installed[1] / "share" / "palpate").string() + " or " PALPATE_SOURCE_DIR);
}

std::vector<std::string> shippedScenes() { return namesIn(scenesFolder(), ".yaml"); }

std::string sceneFile(const std::string& scene) {
  constexpr char kPackage[] = "package://";
  if (scene.rfind(kPackage, 0) == 0) {
    try {
      return resolveResource(scene, ".");
    } catch (const std::invalid_argument& error) {
      throw InputError(scene, "", "", error.what());
    }
  }
  std::error_code ignored;
  if (scene.find_first_of("/.") != std::string::npos || fs::is_regular_file(scene, ignored)) {
    return scene;
  }
  const std::vector<std::string> names = shippedScenes();
  if (std::binary_search(names.begin(), names.end(), scene)) {
    return (scenesFolder() / (scene + ".yaml")).string();
  }
  const std::string nearest = nearestName(scene, names);
  throw InputError(scene, "", "",
                   "is no file and no shipped scene" +
                       (nearest.empty() ? "" : " (did you mean " + nearest + "?)") +
                       "; shipped are " + joinNames(names));
}

std::string shippedTrajectory(const std::string& scene_file) {
  const fs::path file(scene_file), folder = scenesFolder();
  std::error_code ignored;
  if (!fs::equivalent(file, folder / file.filename(), ignored)) return "";
  const fs::path trajectories = folder.parent_path() / "trajectories";
  const std::string scene = file.stem().string();
  std::vector<std::string> alike;
  for (const std::string& name : namesIn(trajectories, ".csv")) {
    if (name == scene) return (trajectories / (name + ".csv")).string();
    if (firstWord(name) == firstWord(scene)) alike.push_back(name);
  }
  return alike.size() == 1 ? (trajectories / (alike.front() + ".csv")).string() : "";
}

}  // namespace palpate::start
