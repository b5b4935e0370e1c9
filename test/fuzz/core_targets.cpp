// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>

#include "formats/surface_samples.h"
#include "formats/tet_samples.h"
#include "memory_targets.h"
#include "mesh_targets.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"
#include "targets.h"
#include "text_targets.h"

namespace palpate::fuzz {
namespace {

// Of the tests of formats.
std::vector<std::string> samplesOf(const std::string& extension) {
  std::vector<std::string> files;
  for (const auto& samples : {formats::surfaceSamples(), formats::tetSamples()}) {
    for (const formats::Sample& sample : samples) {
      if (sample.extension == extension) files.push_back(sample.bytes);
    }
  }
  return files;
}

// Of the package.
std::vector<std::string> shipped(const std::string& kind) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::sourceFolder() + "/config/" + kind)) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> files;
  for (const auto& path : paths) files.push_back(test::fileBytes(path.string()));
  return files;
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
      {"obj", readObj, [] { return samplesOf(".obj"); }},
      {"off", readOff, [] { return samplesOf(".off"); }},
      {"stl", readStl, [] { return samplesOf(".stl"); }},
      {"ply", readPly, [] { return samplesOf(".ply"); }},
      {"wrl", readWrl, [] { return samplesOf(".wrl"); }},
      {"msh", readMsh, [] { return samplesOf(".msh"); }},
      {"vtk", readVtk, [] { return samplesOf(".vtk"); }},
      {"vtu", readVtu, [] { return samplesOf(".vtu"); }},
      {"mesh", readMesh, [] { return samplesOf(".mesh"); }},
      {"repair", repairSurface},
      {"urdf", readUrdf, [] { return shipped("instruments"); }},
      {"scene", readSceneFile, [] { return shipped("scenes"); }},
      {"case", readCaseFile},
      {"tissue", readTissue, [] { return shipped("materials"); }},
      {"trajectory", readTrajectoryFile},
      {"springs", readSpringsFile},
      {"state", readStateFile, stateFiles},
      {"surrogate", readSurrogateFile, surrogateFiles},
      {"database", readDatabaseFolder, databaseFolders},
      // With what a simulator makes of itself at its first cycles.
      {"restore", goOnFrom, payloads, 256.0, std::size_t{64} << 20},
  };
  return all;
}

}  // namespace palpate::fuzz
