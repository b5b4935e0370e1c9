// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/planar_mesh.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <list>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace palpate::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using Face = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>, CGAL::Exact_predicates_tag>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;
using Mesher = CGAL::Delaunay_mesher_2<Triangulation, Criteria>;

// Twice the area, positive for counter-clockwise order.
double turn(const Polygon& p) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < p.cols(); ++i) {
    const Eigen::Vector2d a = p.col(i), b = p.col((i + 1) % p.cols());
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

void check(const Polygon& polygon, const char* name) {
  if (polygon.cols() < 3 || !polygon.allFinite() || turn(polygon) == 0.0) {
    throw std::invalid_argument(std::string(name) + ": must have 3 corners or more and an area");
  }
}

// Inserts corners and sides. @returns the number of corners.
std::size_t insert(const Polygon& polygon, double edge_length, Triangulation* triangulation) {
  std::vector<Triangulation::Vertex_handle> corners;
  for (Eigen::Index i = 0; i < polygon.cols(); ++i) {
    const Eigen::Vector2d a = polygon.col(i), b = polygon.col((i + 1) % polygon.cols());
    const int parts = std::max(1, static_cast<int>(std::lround((b - a).norm() / edge_length)));
    for (int k = 0; k < parts; ++k) {
      const Eigen::Vector2d p = a + (b - a) * (double(k) / parts);
      corners.push_back(triangulation->insert(Kernel::Point_2(p.x(), p.y())));
    }
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    triangulation->insert_constraint(corners[i], corners[(i + 1) % corners.size()]);
  }
  return corners.size();
}

// Whether no sides meet except at their ends; otherwise there are more vertices, or more than two
// sides at one.
bool simple(const Triangulation& triangulation, std::size_t corners) {
  if (triangulation.number_of_vertices() != corners) return false;
  for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end();
       ++v) {
    std::vector<Triangulation::Edge> sides;
    triangulation.are_there_incident_constraints(v, std::back_inserter(sides));
    if (sides.size() != 2) return false;
  }
  return true;
}

// An inner point: the centroid of a triangle of the polygon's triangulation.
Kernel::Point_2 inside(const Polygon& polygon) {
  Triangulation own;
  insert(polygon, std::numeric_limits<double>::infinity(), &own);
  Mesher(own).init();
  for (auto face = own.finite_faces_begin(); face != own.finite_faces_end(); ++face) {
    if (face->is_in_domain()) return CGAL::centroid(own.triangle(face));
  }
  throw std::invalid_argument("a hole has no inside");
}

// Sorts points by x, then y; triangles by corners, the least first. CGAL's order depends on memory
// addresses.
SurfaceMesh inOrder(const Triangulation& triangulation) {
  std::vector<Triangulation::Face_handle> faces;
  std::map<Kernel::Point_2, int> index;
  for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end();
       ++face) {
    if (!face->is_in_domain()) continue;
    faces.push_back(face);
    for (int k = 0; k < 3; ++k) index.emplace(face->vertex(k)->point(), 0);
  }
  SurfaceMesh mesh;
  mesh.points.resize(3, static_cast<Eigen::Index>(index.size()));
  int number = 0;
  for (auto& [point, place] : index) {
    mesh.points.col(number) = Vec3(point.x(), point.y(), 0.0);
    place = number++;
  }
  std::vector<std::array<int, 3>> triangles;
  triangles.reserve(faces.size());
  for (const auto face : faces) {
    std::array<int, 3> t{};
    for (int k = 0; k < 3; ++k) t[static_cast<std::size_t>(k)] = index[face->vertex(k)->point()];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  mesh.triangles.resize(3, static_cast<Eigen::Index>(triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    mesh.triangles.col(static_cast<Eigen::Index>(i)) = Eigen::Vector3i(triangles[i].data());
  }
  return mesh;
}

}  // namespace

Polygon circle(const Eigen::Vector2d& centre, double radius, double edge_length) {
  constexpr double kTurn = 6.283185307179586;
  const int sides = std::max(3, static_cast<int>(std::lround(kTurn * radius / edge_length)));
  Polygon polygon(2, sides);
  for (int i = 0; i < sides; ++i) {
    const double angle = kTurn * i / sides;
    polygon.col(i) = centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return polygon;
}

SurfaceMesh meshPolygon(const Polygon& outline, const std::vector<Polygon>& holes,
                        double edge_length) {
  check(outline, "outline");
  for (const Polygon& hole : holes) check(hole, "hole");
  if (!(edge_length > 0.0 &&
        0.5 * std::abs(turn(outline)) < kMaxPlanarTriangles * 0.43 * edge_length * edge_length)) {
    throw std::invalid_argument("edge_length: must be > 0 and not too small for the polygon");
  }
  // Mean edge over the criterion's bound.
  constexpr double kMeanOfBound = 0.75;
  constexpr double kShape = 0.125;  // squared sine of the least angle, 20.7 degrees
  Triangulation triangulation;
  std::size_t corners = insert(outline, edge_length, &triangulation);
  for (const Polygon& hole : holes) corners += insert(hole, edge_length, &triangulation);
  if (!simple(triangulation, corners)) {
    throw std::invalid_argument("sides of the polygons cross or touch");
  }
  std::list<Kernel::Point_2> seeds;
  for (const Polygon& hole : holes) seeds.push_back(inside(hole));
  Mesher mesher(triangulation);
  mesher.set_seeds(seeds.begin(), seeds.end(), false);
  mesher.set_criteria(Criteria(kShape, edge_length / kMeanOfBound));
  mesher.refine_mesh();
  return inOrder(triangulation);
}

}  // namespace palpate::mesh
