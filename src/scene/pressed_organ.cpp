// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/pressed_organ.h"

#include <cstdio>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "palpate/base/content_hash.h"
#include "palpate/base/error.h"
#include "palpate/base/state_bytes.h"
#include "palpate/mesh/cell_mesh.h"
#include "palpate/mesh/mesh_cache.h"
#include "palpate/mesh/surface_levels.h"
#include "palpate/mesh/surface_points.h"
#include "palpate/scene/composition.h"
#include "palpate/scene/tissue_file.h"

namespace palpate::scene {
namespace {

struct Body {
  std::string file, key, element;
  mesh::TetMesh mesh;
  fem::Composition composition;
  fem::FreeMask free;
  double edge_length, patch;
};

void makeSurfaces(const enrichment::DatabasePlan& plan, const mesh::SurfaceMesh& surface,
                  enrichment::PressedSurfaces* made) {
  made->coarse = mesh::simplify(surface, plan.triangles);
  mesh::moveOnto(surface, 0, &made->coarse.points);
  made->fine = made->coarse;
  for (int k = 0; k < plan.splits; ++k) {
    const Eigen::Index before = made->fine.points.cols();
    made->fine = mesh::splitTriangles(made->fine);
    mesh::moveOnto(surface, before, &made->fine.points);
  }
}

double meanEdge(const mesh::SurfaceMesh& surface) {
  return mesh::meanEdgeLength({surface.points, surface.triangles, {}});
}

// Points whose nearest point on the body's boundary has free nodes only, within the ball if given.
std::vector<int> freePoints(const Body& body, const Points& points,
                            const std::optional<enrichment::PressBall>& within) {
  const mesh::SurfaceMesh boundary{body.mesh.points,
                                   mesh::trianglesOf(mesh::boundaryFaces(body.mesh))};
  std::vector<int> found;
  int i = 0;
  for (const mesh::SurfacePoint& place : mesh::nearestSurfacePoints(boundary, points)) {
    bool free = true;
    for (int k = 0; k < 3; ++k) free &= body.free.col(place.nodes[k]).minCoeff() > 0.0;
    if (within) free &= (points.col(i) - within->center).norm() <= within->radius;
    if (free) found.push_back(i);
    ++i;
  }
  return found;
}

// Version of the pressing procedure; increase it with each change of results.
constexpr int kWayOfPressing = 1;

std::string describe(const MaterialConfig& material, const Body& body, const std::string& key) {
  const MaterialConfig written = writtenOut(material, body.file, key).config;
  std::ostringstream text;
  text.precision(17);
  text << written.law;
  for (const auto& [name, values] : written.constants) {
    text << " " << name;
    for (const double value : values) text << " " << value;
  }
  return text.str();
}

// Text of the materials, that of the body first.
std::string describeMaterials(const OrganConfig& organ, const Body& body) {
  std::string text = describe(organ.material, body, body.key + ".material");
  for (std::size_t i = 0; i < organ.regions.size(); ++i) {
    if (!organ.regions[i].material) continue;
    const std::string key = body.key + ".regions[" + std::to_string(i) + "].material";
    text += "; " + describe(*organ.regions[i].material, body, key);
  }
  return text;
}

// Hash of tetrahedra, materials, directions and held nodes.
std::string bodyMark(const Body& body) {
  StateWriter bits;
  bits.put(body.mesh.points);
  bits.put(body.mesh.tets);
  bits.put(body.composition.solid_of);
  bits.put(body.composition.frames);
  bits.put(body.mesh.midnodes);
  bits.put(body.free);
  ContentHash hash(0);
  hash.add(bits.bytes());
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash.value()));
  return text;
}

std::string describe(const enrichment::DatabasePlan& all, const Body& body, const Scene& scene,
                     const OrganConfig& organ) {
  const enrichment::PressPlan& plan = all.press;
  const std::optional<enrichment::PressBall>& within = all.within;
  std::ostringstream text;
  text.precision(17);
  text << "organ " << organ.name << " of " << scene.name << ", " << body.element << ", edges "
       << body.edge_length << " m, patch " << body.patch << " m, seed " << plan.seed << ", force "
       << plan.force << " N, cone " << plan.cone << "; " << describeMaterials(organ, body);
  if (within) {
    text << "; within " << within->radius << " m of " << within->center.transpose();
  }
  text << "; held " << (body.free.array() == 0.0).count() << " of " << body.free.size()
       << ", tetrahedra " << body.mesh.numTets() << ", body " << bodyMark(body)
       << ", pressed by way " << kWayOfPressing;
  return text.str();
}

}  // namespace

PressedOrgan describePresses(const Scene& scene, int index,
                             const tissue::OrganDescription& description,
                             const enrichment::DatabasePlan& plan,
                             const mesh::MeshingProgress& progress) {
  const OrganConfig& organ = scene.organs[static_cast<std::size_t>(index)];
  const auto body = std::make_shared<Body>();
  body->file = scene.file;
  body->key = "organs[" + std::to_string(index) + "]";
  body->element = organ.element;
  PressedOrgan pressed;
  enrichment::PressedSurfaces& surfaces = pressed.surfaces;
  const mesh::SurfaceMesh surface = description.surface();
  makeSurfaces(plan, surface, &surfaces);
  body->edge_length = plan.edge_length.value_or(meanEdge(surfaces.fine));
  body->patch = plan.patch.value_or(meanEdge(surfaces.coarse));
  mesh::MeshingOptions meshing;
  meshing.edge_length.coarsest = body->edge_length;
  meshing.file = scene.file;
  body->mesh = fem::meshFor(
      body->element,
      mesh::meshVolumeCached(surface, meshing, mesh::defaultCacheDirectory(), progress));
  body->composition = composeBody(organ, body->mesh, Mat3::Identity(), scene.file, body->key);
  body->free = description.free(body->mesh.points);
  const std::string motions = fem::freeRigidMotions(body->mesh.points, body->free);
  if (!motions.empty()) {
    throw InputError(scene.file, body->key + ".supports", "",
                     "must hold the organ for static presses; they leave " + motions);
  }
  surfaces.contacts = freePoints(*body, surfaces.coarse.points, plan.within);
  if (surfaces.contacts.empty() && plan.within) {
    throw InputError("command line", "--within", "",
                     "must hold points of the coarse surface that are free; it has " +
                         std::to_string(surfaces.coarse.points.cols()) + " in all");
  }
  if (surfaces.contacts.empty()) {
    throw InputError(scene.file, body->key + ".supports", "",
                     "must leave points of the surface free to be pressed");
  }
  surfaces.plan = plan.press;
  surfaces.made_by = describe(plan, *body, scene, organ);
  pressed.nodes = body->mesh.numPoints();
  pressed.tetrahedra = body->mesh.numTets();
  surfaces.make_body = [body, fine = surfaces.fine.points] {
    try {
      return std::make_unique<enrichment::PressedBody>(body->element, body->mesh, body->composition,
                                                       body->free, fine, body->patch, nullptr);
    } catch (const std::invalid_argument& error) {
      throw InputError(body->file, body->key + ".element", body->element, error.what());
    }
  };
  return pressed;
}

}  // namespace palpate::scene
