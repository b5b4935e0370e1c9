// SPDX-License-Identifier: GPL-3.0-or-later
#include "repair.h"

#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/repair.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "convert.h"

namespace palpate::mesh::cgal {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

int countBorderEdges(const Mesh& mesh) {
  int count = 0;
  for (const auto e : mesh.edges()) count += mesh.is_border(e) ? 1 : 0;
  return count;
}

/// One halfedge of each hole's border, and the border's length.
std::vector<std::pair<Mesh::Halfedge_index, double>> findHoles(const Mesh& mesh) {
  std::vector<std::pair<Mesh::Halfedge_index, double>> holes;
  std::vector<bool> seen(mesh.num_halfedges(), false);
  for (const auto start : mesh.halfedges()) {
    if (!mesh.is_border(start) || seen[start.idx()]) continue;
    double length = 0.0;
    for (auto h = start; !seen[h.idx()]; h = mesh.next(h)) {
      seen[h.idx()] = true;
      length +=
          std::sqrt(CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
    }
    holes.emplace_back(start, length);
  }
  return holes;
}

}  // namespace

SurfaceMesh orientAndClose(const SurfaceMesh& surface, double max_hole_share,
                           ClosingCounts* counts) {
  Soup soup = toSoup(surface);
  PMP::orient_polygon_soup(soup.points, soup.polygons);
  counts->split_points =
      static_cast<int>(soup.points.size()) - static_cast<int>(surface.points.cols());
  Mesh mesh = toMesh<Mesh>(soup);

  const int open_edges = countBorderEdges(mesh);
  if (open_edges == 0) return fromMesh(std::move(mesh));
  PMP::stitch_borders(mesh);
  counts->stitched_edges = open_edges - countBorderEdges(mesh);

  constexpr double kPi = 3.14159265358979323846;
  const double max_rim = std::sqrt(4.0 * kPi * max_hole_share * PMP::area(mesh));
  for (const auto& [rim, length] : findHoles(mesh)) {
    if (length > max_rim) continue;
    std::vector<Mesh::Face_index> patch;
    PMP::triangulate_hole(mesh, rim, std::back_inserter(patch));
    counts->holes += patch.empty() ? 0 : 1;
    counts->hole_triangles += static_cast<int>(patch.size());
  }
  PMP::remove_isolated_vertices(mesh);
  return fromMesh(std::move(mesh));
}

std::vector<int> selfIntersections(const SurfaceMesh& surface) {
  const Soup soup = toSoup(surface);
  if (!PMP::is_polygon_soup_a_polygon_mesh(soup.polygons)) return {};
  const Mesh mesh = toMesh<Mesh>(soup);
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  PMP::self_intersections(mesh, std::back_inserter(pairs));
  std::vector<int> faces;
  for (const auto& [a, b] : pairs) {
    faces.push_back(static_cast<int>(a.idx()));
    faces.push_back(static_cast<int>(b.idx()));
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

SurfaceMesh orientOutward(const SurfaceMesh& surface) {
  Mesh mesh = toMesh<Mesh>(toSoup(surface));
  PMP::orient_to_bound_a_volume(mesh);
  return fromMesh(std::move(mesh));
}

}  // namespace palpate::mesh::cgal
