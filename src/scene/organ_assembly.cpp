// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/organ_assembly.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "organ_deformations.h"
#include "organ_elements.h"
#include "palpate/base/error.h"
#include "palpate/base/resource.h"
#include "palpate/formats/surface_io.h"
#include "palpate/formats/tet_io.h"
#include "palpate/mesh/mesh_cache.h"
#include "palpate/mesh/size_check.h"
#include "palpate/mesh/surface_check.h"
#include "palpate/mesh/used_points.h"
#include "palpate/scene/composition.h"
#include "palpate/scene/tissue_file.h"
#include "palpate/tissue/model_list.h"
#include "surroundings.h"
#include "tool_path.h"

namespace palpate::scene {
namespace {

std::string resolve(const std::string& uri, const std::string& scene_file, const std::string& key) {
  try {
    return resolveResource(uri, std::filesystem::path(scene_file).parent_path().string());
  } catch (const std::invalid_argument& error) {
    throw InputError(scene_file, key, uri, error.what());
  }
}

mesh::SurfaceMesh readAsItIs(const OrganConfig& organ, const std::string& file,
                             const std::string& scene_file) {
  mesh::SurfaceMesh surface = formats::readSurface(file);
  surface.points *= organ.scale;
  mesh::checkSize(surface.points, scene_file, "organ " + organ.name + ".scale");
  return surface;
}

mesh::SurfaceMesh readOrganSurface(const OrganConfig& organ, const std::string& file,
                                   const std::string& scene_file,
                                   std::vector<std::string>* warnings) {
  mesh::SurfaceMesh surface = readAsItIs(organ, file, scene_file);
  mesh::SurfaceReport report;
  surface = mesh::repairSurface(surface, file, &report);
  for (const std::string& repair : report.repairs) warnings->push_back(file + ": " + repair);
  return surface;
}

mesh::TetMesh readTetrahedra(const OrganConfig& organ, const std::string& scene_file) {
  const std::string key = "organ " + organ.name;
  const std::string file = resolve(organ.tetrahedra, scene_file, key + ".tetrahedra");
  mesh::TetMesh mesh = formats::readTetMesh(file);
  mesh.points *= organ.scale;
  mesh::checkSize(mesh.points, scene_file, key + ".scale");
  return mesh;
}

tissue::ModelSettings settingsOf(const Scene& scene, const contact::SampleSpacing& sample_spacing) {
  tissue::ModelSettings settings;
  static_cast<solver::StepSettings&>(settings) = scene.solver;
  settings.gravity = scene.gravity;
  settings.contact = scene.contact;
  settings.touching = scene.contact;
  settings.sample_spacing = sample_spacing;
  settings.skip = scene.solver.skip;
  settings.needles = std::any_of(scene.instruments.begin(), scene.instruments.end(),
                                 [](const InstrumentConfig& i) { return !i.needle.link.empty(); });
  return settings;
}

std::string keyOf(int organ) { return "organs[" + std::to_string(organ) + "]"; }

}  // namespace

tissue::OrganDescription describeOrgan(const Scene& scene, int index, const Progress& progress,
                                       std::vector<std::string>* warnings) {
  const OrganConfig& organ = scene.organs[static_cast<std::size_t>(index)];
  const std::string key = keyOf(index);
  tissue::OrganDescription description;
  description.name = organ.name;
  description.X_WO = organ.pose.pose();
  description.element = organ.element;
  description.damping = organ.damping;
  description.adapt = organ.adapt;
  description.springs = organ.springs;
  description.cloth = organ.cloth;
  description.sampling = organ.sampling;
  description.hybrid = organ.hybrid;
  description.neural = organ.neural;
  if (!organ.neural.file.empty()) {
    description.neural.file = resolve(organ.neural.file, scene.file, key + ".neural.file");
  }
  if (!organ.springs.file.empty()) {
    description.springs.file = resolve(organ.springs.file, scene.file, key + ".springs.file");
  }
  description.honeycomb = organ.honeycomb;
  description.enriched = organ.enriched;
  description.tetrahedra = [&scene, &organ, &progress, warnings] {
    return readOrganMesh(scene, organ, progress, warnings);
  };
  description.surface = [&scene, &organ, warnings] {
    return readOrganSurface(organ, scene.file, warnings);
  };
  description.surface_elements = [&scene, &organ, key, warnings] {
    return readOrganElements(scene, organ, key, warnings);
  };
  if (!organ.surface.empty()) {
    description.sheet = [&scene, &organ, key] {
      return readAsItIs(organ, resolve(organ.surface, scene.file, key + ".surface"), scene.file);
    };
  }
  description.free = [&scene, &organ, key](const Points& X) { return glued(scene, organ, X, key); };
  description.surroundings = [&scene, &organ, key](const mesh::TetMesh& mesh) {
    return surroundingsOf(scene, organ, mesh, key);
  };
  description.composition = [&scene, &organ, key](const mesh::TetMesh& mesh) {
    return composeBody(organ, mesh, organ.pose.pose().linear(), scene.file, key);
  };
  description.deformations = [&scene, index, &progress, warnings] {
    return organDeformations(scene, index, progress, warnings);
  };
  description.solid = [&scene, &organ, key] {
    return makeSolid(organ.material, scene.file, key + ".material");
  };
  return description;
}

mesh::TetMesh readOrganMesh(const Scene& scene, const OrganConfig& organ, const Progress& progress,
                            std::vector<std::string>* warnings) {
  if (organ.surface.empty()) return readTetrahedra(organ, scene.file);
  const mesh::MeshingOptions options = meshingOptions(scene, organ);
  const mesh::SurfaceMesh surface = readOrganSurface(organ, options.file, scene.file, warnings);
  return mesh::meshVolumeCached(surface, options, mesh::defaultCacheDirectory(), progress);
}

mesh::SurfaceMesh readOrganSurface(const OrganConfig& organ, const std::string& scene_file,
                                   std::vector<std::string>* warnings) {
  if (organ.surface.empty()) {
    const mesh::TetMesh mesh = readTetrahedra(organ, scene_file);
    return mesh::onlyUsedPoints({mesh.points, mesh::trianglesOf(mesh::boundaryFaces(mesh))});
  }
  const std::string file = resolve(organ.surface, scene_file, "organ " + organ.name + ".surface");
  return readOrganSurface(organ, file, scene_file, warnings);
}

mesh::MeshingOptions meshingOptions(const Scene& scene, const OrganConfig& organ) {
  mesh::MeshingOptions options;
  options.edge_length.coarsest = organ.edge_length.coarsest;
  for (std::size_t i = 0; i < organ.edge_length.near.size(); ++i) {
    options.edge_length.near.push_back(organ.edge_length.near[i]);
    if (organ.edge_length.near[i].trajectory.empty()) continue;
    options.edge_length.near[i].where = toolPath(scene, organ, i);
  }
  options.file = resolve(organ.surface, scene.file, "organ " + organ.name + ".surface");
  return options;
}

std::unique_ptr<tissue::TissueModel> assembleModel(
    const Scene& scene, const std::vector<int>& organs,
    const contact::SampleSpacing& sample_spacing,
    const std::vector<contact::FrictionTable>& frictions, ThreadPool* pool,
    const Progress& progress, std::vector<std::string>* warnings) {
  tissue::ModelDescription description;
  for (int i : organs) {
    description.organs.push_back(describeOrgan(scene, i, progress, warnings));
    description.organs.back().friction = frictions[static_cast<std::size_t>(i)];
  }
  description.settings = settingsOf(scene, sample_spacing);
  description.pool = pool;
  description.progress = progress;
  description.warnings = warnings;
  const std::string& name = scene.organs[static_cast<std::size_t>(organs.front())].model;
  try {
    return tissue::makeModel(name, description);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(scene.file, organs.size() == 1 ? keyOf(organs.front()) : "organs", "",
                     error.what());
  }
}

}  // namespace palpate::scene
