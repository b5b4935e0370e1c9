// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/remesh.h"

#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <utility>

#include "convert.h"

namespace palpate::mesh {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

constexpr int kRelaxations = 3;
constexpr double kSharp = 60.0;  // between normals [degrees]

}  // namespace

SurfaceMesh remesh(const SurfaceMesh& surface, double edge_length, int iterations) {
  cgal::Mesh mesh = cgal::toMesh<cgal::Mesh>(cgal::toSoup(surface));
  PMP::isotropic_remeshing(
      mesh.faces(), edge_length, mesh,
      PMP::parameters::number_of_iterations(iterations).number_of_relaxation_steps(kRelaxations));
  return cgal::fromMesh(std::move(mesh));
}

SurfaceMesh remeshWithEdges(const SurfaceMesh& surface, double edge_length, int iterations) {
  cgal::Mesh mesh = cgal::toMesh<cgal::Mesh>(cgal::toSoup(surface));
  const auto sharp = mesh.add_property_map<cgal::Mesh::Edge_index, bool>("e:sharp", false).first;
  PMP::detect_sharp_edges(mesh, kSharp, sharp);
  PMP::isotropic_remeshing(mesh.faces(), edge_length, mesh,
                           PMP::parameters::number_of_iterations(iterations)
                               .number_of_relaxation_steps(kRelaxations)
                               .edge_is_constrained_map(sharp));
  return cgal::fromMesh(std::move(mesh));
}

}  // namespace palpate::mesh
