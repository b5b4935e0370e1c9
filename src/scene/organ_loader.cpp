// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/organ_loader.h"

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/base/resource.h"
#include "palpate/fem/elasticity.h"
#include "palpate/formats/surface_io.h"
#include "palpate/formats/tet_io.h"
#include "palpate/mesh/mesh_cache.h"
#include "palpate/mesh/size_check.h"
#include "palpate/mesh/surface_check.h"
#include "palpate/scene/composition.h"
#include "palpate/tissue/islands.h"

namespace palpate::scene {
namespace {

std::string resolve(const std::string& uri, const std::string& scene_file, const std::string& key) {
  try {
    return resolveResource(uri, std::filesystem::path(scene_file).parent_path().string());
  } catch (const std::invalid_argument& error) {
    throw InputError(scene_file, key, uri, error.what());
  }
}

mesh::TetMesh meshSurface(const OrganConfig& organ, const std::string& file,
                          const std::string& scene_file, const LoadProgress& progress,
                          std::vector<std::string>* warnings) {
  mesh::SurfaceMesh surface = formats::readSurface(file);
  surface.points *= organ.scale;
  mesh::checkSize(surface.points, scene_file, "organ " + organ.name + ".scale");
  mesh::SurfaceReport report;
  surface = mesh::repairSurface(surface, file, &report);
  for (const std::string& repair : report.repairs) warnings->push_back(file + ": " + repair);
  mesh::MeshingOptions options;
  options.edge_length = organ.edge_length;
  options.file = file;
  return mesh::meshVolumeCached(surface, options, mesh::defaultCacheDirectory(), progress);
}

fem::FreeMask supportMask(const OrganConfig& organ, const Points& X, const std::string& scene_file,
                          const std::string& key) {
  fem::FreeMask free = fem::FreeMask::Ones(3, X.cols());
  for (std::size_t s = 0; s < organ.supports.size(); ++s) {
    const std::vector<int> nodes = mesh::selectPoints(X, organ.supports[s].select);
    if (nodes.empty()) {
      const Vec3 low = X.rowwise().minCoeff(), high = X.rowwise().maxCoeff();
      const auto text = [](const Vec3& v) {
        return "[" + std::to_string(v.x()) + ", " + std::to_string(v.y()) + ", " +
               std::to_string(v.z()) + "]";
      };
      throw InputError(scene_file, key + ".supports[" + std::to_string(s) + "].select", "",
                       "must select at least one node; the organ reaches from " + text(low) +
                           " to " + text(high) + " m in its own frame");
    }
    for (int i : nodes) free.col(i).setZero();
  }
  return free;
}

}  // namespace

mesh::TetMesh loadOrganMesh(const OrganConfig& organ, const std::string& scene_file,
                            const LoadProgress& progress, std::vector<std::string>* warnings) {
  const std::string key = "organ " + organ.name;
  if (!organ.surface.empty()) {
    const std::string file = resolve(organ.surface, scene_file, key + ".surface");
    return meshSurface(organ, file, scene_file, progress, warnings);
  }
  const std::string file = resolve(organ.tetrahedra, scene_file, key + ".tetrahedra");
  mesh::TetMesh mesh = formats::readTetMesh(file);
  mesh.points *= organ.scale;
  mesh::checkSize(mesh.points, scene_file, key + ".scale");
  return mesh;
}

std::unique_ptr<tissue::TissueModel> loadTissue(const Scene& scene, std::size_t index,
                                                double sample_spacing, ThreadPool* pool,
                                                const LoadProgress& progress,
                                                std::vector<std::string>* warnings) {
  const OrganConfig& organ = scene.organs[index];
  const std::string key = "organs[" + std::to_string(index) + "]";
  mesh::TetMesh mesh =
      fem::meshFor(organ.element, loadOrganMesh(organ, scene.file, progress, warnings));
  const fem::FreeMask free = supportMask(organ, mesh.points, scene.file, key);
  const fem::Composition composition =
      composeBody(organ, mesh, organ.pose.pose().linear(), scene.file, key);
  mesh.points = (organ.pose.pose() * mesh.points.colwise().homogeneous()).eval();

  tissue::FemSettings settings;
  static_cast<solver::StepSettings&>(settings) = scene.solver;
  settings.element = organ.element;
  settings.mass_damping = organ.damping.mass;
  settings.stiffness_damping = organ.damping.stiffness;
  settings.gravity = scene.gravity;
  settings.penalty = scene.contact;
  settings.sample_spacing = sample_spacing;
  settings.skip = scene.solver.skip;
  try {
    return tissue::makeIslands(mesh, composition, free, settings, pool);
  } catch (const std::exception& error) {
    throw InputError(scene.file, key, "", error.what());
  }
}

}  // namespace palpate::scene
