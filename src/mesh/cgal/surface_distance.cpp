// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <vector>

#include "palpate/mesh/selection.h"

namespace palpate::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 pointOf(const Points& points, Eigen::Index i) {
  return {points(0, i), points(1, i), points(2, i)};
}

}  // namespace

Eigen::VectorXd surfaceDistances(const TetMesh& mesh, const Points& points) {
  const Eigen::Matrix3Xi boundary = boundaryTriangles(mesh.tets);
  Triangles triangles;
  triangles.reserve(static_cast<std::size_t>(boundary.cols()));
  for (Eigen::Index t = 0; t < boundary.cols(); ++t) {
    triangles.emplace_back(pointOf(mesh.points, boundary(0, t)),
                           pointOf(mesh.points, boundary(1, t)),
                           pointOf(mesh.points, boundary(2, t)));
  }
  Tree tree(triangles.begin(), triangles.end());
  Eigen::VectorXd distances(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    distances[i] = std::sqrt(tree.squared_distance(pointOf(points, i)));
  }
  return distances;
}

}  // namespace palpate::mesh
