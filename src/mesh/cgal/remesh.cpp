// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/remesh.h"

#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <utility>

#include "convert.h"

namespace palpate::mesh {

SurfaceMesh remesh(const SurfaceMesh& surface, double edge_length, int iterations) {
  namespace PMP = CGAL::Polygon_mesh_processing;
  cgal::Mesh mesh = cgal::toMesh<cgal::Mesh>(cgal::toSoup(surface));
  PMP::isotropic_remeshing(
      mesh.faces(), edge_length, mesh,
      PMP::parameters::number_of_iterations(iterations).number_of_relaxation_steps(3));
  return cgal::fromMesh(std::move(mesh));
}

}  // namespace palpate::mesh
