// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh::cgal {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

struct Soup {
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
};

inline Soup toSoup(const SurfaceMesh& surface) {
  Soup soup;
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i) {
    soup.points.emplace_back(surface.points(0, i), surface.points(1, i), surface.points(2, i));
  }
  for (Eigen::Index i = 0; i < surface.triangles.cols(); ++i) {
    const Eigen::Vector3i t = surface.triangles.col(i);
    soup.polygons.push_back({static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                             static_cast<std::size_t>(t[2])});
  }
  return soup;
}

/// Points and polygons of `soup` in their order, as a CGAL mesh.
template <class PolygonMesh>
PolygonMesh toMesh(const Soup& soup) {
  PolygonMesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  return mesh;
}

/// Mesh without removed and isolated elements, in its order.
inline SurfaceMesh fromMesh(Mesh mesh) {
  mesh.collect_garbage();
  SurfaceMesh surface;
  surface.points.resize(3, mesh.number_of_vertices());
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    surface.points.col(v.idx()) = Vec3(p.x(), p.y(), p.z());
  }
  surface.triangles.resize(3, mesh.number_of_faces());
  for (const auto f : mesh.faces()) {
    int corner = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      if (corner < 3) surface.triangles(corner++, f.idx()) = static_cast<int>(v.idx());
    }
  }
  return surface;
}

}  // namespace palpate::mesh::cgal
