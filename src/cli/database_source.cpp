// SPDX-License-Identifier: GPL-3.0-or-later
#include "database_source.h"

#include <sstream>
#include <stdexcept>

#include "options.h"
#include "organ_choice.h"
#include "palpate/mesh/cell_mesh.h"
#include "palpate/mesh/mesh_cache.h"
#include "palpate/mesh/surface_levels.h"
#include "palpate/mesh/surface_places.h"
#include "palpate/scene/organ_assembly.h"

namespace palpate::cli {
namespace {

void makeSurfaces(const DatabaseChoice& choice, const mesh::SurfaceMesh& surface,
                  DatabaseSource* source) {
  try {
    source->coarse = mesh::simplify(surface, choice.triangles);
  } catch (const std::invalid_argument& error) {
    throw InputError("command line", "--triangles", std::to_string(choice.triangles), error.what());
  }
  mesh::moveOnto(surface, 0, &source->coarse.points);
  source->fine = source->coarse;
  for (int k = 0; k < choice.splits; ++k) {
    const Eigen::Index before = source->fine.points.cols();
    source->fine = mesh::splitTriangles(source->fine);
    mesh::moveOnto(surface, before, &source->fine.points);
  }
}

// Points whose place on the body's boundary is of free nodes only.
std::vector<int> freePoints(const DatabaseSource& source) {
  const mesh::SurfaceMesh boundary{source.mesh.points,
                                   mesh::trianglesOf(mesh::boundaryFaces(source.mesh))};
  std::vector<int> points;
  int i = 0;
  for (const mesh::FacePlace& place : mesh::nearestPlaces(boundary, source.coarse.points)) {
    bool free = true;
    for (int k = 0; k < 3; ++k) free &= source.free.col(place.nodes[k]).minCoeff() > 0.0;
    if (free) points.push_back(i);
    ++i;
  }
  return points;
}

std::string describe(const DatabaseChoice& choice, const DatabaseSource& source,
                     const scene::Scene& scene, const scene::OrganConfig& organ) {
  std::ostringstream text;
  text.precision(17);
  text << "organ " << organ.name << " of " << scene.name << ", " << source.element << ", edges "
       << source.edge_length << " m, patch " << source.patch << " m, seed " << choice.plan.seed
       << ", force " << choice.plan.force << " N, cone " << choice.plan.cone << "; "
       << organ.material.law;
  for (const auto& [name, values] : organ.material.constants) {
    text << " " << name;
    for (const double value : values) text << " " << value;
  }
  text << "; held " << source.free.size() - source.free.sum() << " of " << source.free.size()
       << ", volumes and nodes " << source.mesh.points.sum() << " " << source.mesh.numTets();
  return text.str();
}

}  // namespace

DatabaseSource readDatabaseSource(const DatabaseChoice& choice,
                                  const mesh::MeshingProgress& progress) {
  const scene::Scene scene = scene::readScene(choice.scene);
  const std::size_t index = organIndex(scene, choice.organ);
  const scene::OrganConfig& organ = scene.organs[index];
  const scene::Progress no_progress;
  std::vector<std::string> repairs;
  const tissue::OrganDescription description =
      scene::describeOrgan(scene, static_cast<int>(index), no_progress, &repairs);
  const mesh::SurfaceMesh surface = description.surface();
  DatabaseSource source;
  source.scene = choice.scene;
  source.key = "organs[" + std::to_string(index) + "]";
  makeSurfaces(choice, surface, &source);
  source.edge_length = choice.edge_length.value_or(
      mesh::meanEdgeLength({source.fine.points, source.fine.triangles, {}}));
  source.patch = choice.patch.value_or(
      mesh::meanEdgeLength({source.coarse.points, source.coarse.triangles, {}}));
  source.element = organ.element;
  mesh::MeshingOptions meshing;
  meshing.edge_length.coarsest = source.edge_length;
  meshing.file = choice.scene;
  source.mesh = fem::meshFor(
      source.element,
      mesh::meshVolumeCached(surface, meshing, mesh::defaultCacheDirectory(), progress));
  source.composition = description.composition(source.mesh);
  source.free = description.free(source.mesh.points);
  const std::string motions = fem::freeRigidMotions(source.mesh.points, source.free);
  if (!motions.empty()) {
    throw InputError(choice.scene, source.key + ".supports", "",
                     "must hold the organ for static presses; they leave " + motions);
  }
  source.contacts = freePoints(source);
  if (source.contacts.empty()) {
    throw InputError(choice.scene, source.key + ".supports", "",
                     "must leave points of the surface free to be pressed");
  }
  source.made_by = describe(choice, source, scene, organ);
  return source;
}

std::unique_ptr<enrichment::PressedBody> DatabaseSource::makeBody() const {
  try {
    return std::make_unique<enrichment::PressedBody>(element, mesh, composition, free, fine.points,
                                                     patch, nullptr);
  } catch (const std::invalid_argument& error) {
    throw InputError(scene, key + ".element", element, error.what());
  }
}

}  // namespace palpate::cli
