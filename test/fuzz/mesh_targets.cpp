// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_targets.h"

#include <stdexcept>

#include "formats/surface_formats.h"
#include "formats/tet_formats.h"
#include "palpate/base/error.h"
#include "palpate/formats/tet_io.h"
#include "palpate/instrument/convex_hull.h"
#include "palpate/instrument/mesh_shape.h"
#include "palpate/mesh/convex_hull.h"
#include "palpate/mesh/surface_check.h"
#include "targets.h"

namespace palpate::fuzz {
namespace {

void look(const mesh::SurfaceMesh& surface) {
  require(surface.triangles.cols() > 0, "a surface without triangles");
  require(surface.points.allFinite(), "a point that is not finite");
  require(surface.triangles.minCoeff() >= 0, "a corner below 0");
  require(surface.triangles.maxCoeff() < surface.points.cols(), "a corner that there is not");
}

void look(const mesh::TetMesh& mesh) {
  require(mesh.numTets() > 0, "a mesh without tetrahedra");
  require(mesh.points.allFinite(), "a point that is not finite");
  require(mesh.tets.minCoeff() >= 0, "a node below 0");
  require(mesh.tets.maxCoeff() < mesh.numPoints(), "a node that there is not");
  if (mesh.quadratic()) {
    require(mesh.midnodes.cols() == mesh.numTets(), "too few middle nodes");
    require(mesh.midnodes.minCoeff() >= 0, "a middle node below 0");
    require(mesh.midnodes.maxCoeff() < mesh.numPoints(), "a middle node that there is not");
  }
  const auto n = static_cast<std::size_t>(mesh.numTets());
  require(mesh.region.empty() || mesh.region.size() == n, "regions of other tetrahedra");
  for (const auto& [name, data] : mesh.cell_data) {
    require(data.cols() == mesh.numTets(), "data of other tetrahedra");
    require(data.rows() == 1 || data.rows() == 3, "data of a strange shape");
  }
  formats::checkTets(mesh, "what was read");
  mesh::boundaryFaces(mesh);
}

}  // namespace

void readObj(std::string_view bytes) { look(formats::parseSurface("hostile.obj", bytes)); }
void readOff(std::string_view bytes) { look(formats::parseSurface("hostile.off", bytes)); }
void readStl(std::string_view bytes) { look(formats::parseSurface("hostile.stl", bytes)); }
void readPly(std::string_view bytes) { look(formats::parseSurface("hostile.ply", bytes)); }
void readWrl(std::string_view bytes) { look(formats::parseSurface("hostile.wrl", bytes)); }
void readMsh(std::string_view bytes) { look(formats::parseTetMesh("hostile.msh", bytes)); }
void readVtk(std::string_view bytes) { look(formats::parseTetMesh("hostile.vtk", bytes)); }
void readVtu(std::string_view bytes) { look(formats::parseTetMesh("hostile.vtu", bytes)); }
void readMesh(std::string_view bytes) { look(formats::parseTetMesh("hostile.mesh", bytes)); }

void repairSurface(std::string_view bytes) {
  const mesh::SurfaceMesh surface = formats::parseSurface("hostile.off", bytes);
  mesh::checkSurface(surface);
  try {
    instrument::MeshShapeSettings settings;
    settings.convex_hull = true;
    instrument::shapeOfMesh(surface, "hostile.off", settings, {});
  } catch (const std::invalid_argument&) {  // as flat points are refused
  }
  mesh::SurfaceReport report;
  look(mesh::repairSurface(surface, "hostile.off", &report));
}

}  // namespace palpate::fuzz
