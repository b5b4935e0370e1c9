// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/surface_levels.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "palpate/mesh/surface_points.h"

namespace palpate::mesh {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Graph = CGAL::Surface_mesh<Kernel::Point_3>;
namespace simplification = CGAL::Surface_mesh_simplification;

Kernel::Point_3 cgalPoint(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
Vec3 vecOf(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

Graph graphOf(const SurfaceMesh& surface) {
  Graph graph;
  std::vector<Graph::Vertex_index> vertices;
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i) {
    vertices.push_back(graph.add_vertex(cgalPoint(surface.points.col(i))));
  }
  const auto at = [&](int i) { return vertices[static_cast<std::size_t>(i)]; };
  for (const auto& t : surface.triangles.colwise()) {
    if (graph.add_face(at(t[0]), at(t[1]), at(t[2])) == Graph::null_face()) {
      throw std::invalid_argument("the surface is no manifold");
    }
  }
  return graph;
}

SurfaceMesh surfaceOf(const Graph& graph) {
  SurfaceMesh surface;
  surface.points.resize(3, static_cast<Eigen::Index>(graph.number_of_vertices()));
  surface.triangles.resize(3, static_cast<Eigen::Index>(graph.number_of_faces()));
  std::vector<int> number(graph.num_vertices());
  int i = 0, t = 0;
  for (const Graph::Vertex_index v : graph.vertices()) {
    surface.points.col(i) = vecOf(graph.point(v));
    number[v.idx()] = i++;
  }
  for (const Graph::Face_index f : graph.faces()) {
    int k = 0;
    for (const auto v : CGAL::vertices_around_face(graph.halfedge(f), graph)) {
      surface.triangles(k++, t) = number[v.idx()];
    }
    ++t;
  }
  return surface;
}

}  // namespace

SurfaceMesh simplify(const SurfaceMesh& surface, int num_triangles) {
  Graph graph = graphOf(surface);
  if (!CGAL::is_closed(graph)) throw std::invalid_argument("the surface is not closed");
  if (num_triangles < 4 || num_triangles % 2 != 0) {
    throw std::invalid_argument(
        "a closed surface has an even number of triangles, at least 4, not " +
        std::to_string(num_triangles));
  }
  const std::size_t edges = static_cast<std::size_t>(num_triangles) * 3 / 2;
  simplification::edge_collapse(graph, simplification::Count_stop_predicate<Graph>(edges + 1));
  if (graph.number_of_faces() != static_cast<std::size_t>(num_triangles)) {
    throw std::invalid_argument("the surface cannot be brought to " +
                                std::to_string(num_triangles) + " triangles, only to " +
                                std::to_string(graph.number_of_faces()));
  }
  return surfaceOf(graph);
}

SurfaceMesh splitTriangles(const SurfaceMesh& surface) {
  std::map<std::pair<int, int>, int> middles;
  std::vector<Vec3> added;
  const auto middle = [&](int a, int b) {
    const auto [at, is_new] = middles.try_emplace(
        std::minmax({a, b}), static_cast<int>(surface.points.cols() + added.size()));
    if (is_new) added.push_back(0.5 * (surface.points.col(a) + surface.points.col(b)));
    return at->second;
  };
  SurfaceMesh split;
  split.triangles.resize(3, 4 * surface.triangles.cols());
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    const Eigen::Vector3i c = surface.triangles.col(t);
    const int m01 = middle(c[0], c[1]), m12 = middle(c[1], c[2]), m20 = middle(c[2], c[0]);
    split.triangles.col(4 * t) << c[0], m01, m20;
    split.triangles.col(4 * t + 1) << c[1], m12, m01;
    split.triangles.col(4 * t + 2) << c[2], m20, m12;
    split.triangles.col(4 * t + 3) << m01, m12, m20;
  }
  split.points.resize(3, surface.points.cols() + static_cast<Eigen::Index>(added.size()));
  split.points.leftCols(surface.points.cols()) = surface.points;
  for (std::size_t i = 0; i < added.size(); ++i) {
    split.points.col(surface.points.cols() + static_cast<Eigen::Index>(i)) = added[i];
  }
  return split;
}

void moveOnto(const SurfaceMesh& surface, Eigen::Index first, Points* points) {
  const Points moved = points->rightCols(points->cols() - first);
  Points there;
  interpolate(nearestSurfacePoints(surface, moved), surface.points, &there);
  points->rightCols(points->cols() - first) = there;
}

}  // namespace palpate::mesh
