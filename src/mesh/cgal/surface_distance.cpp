// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <vector>

#include "palpate/mesh/selection.h"
#include "palpate/mesh/size_field.h"

namespace palpate::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 pointOf(const Vec3& p) { return {p[0], p[1], p[2]}; }

Triangles trianglesOf(const SurfaceMesh& surface) {
  Triangles triangles;
  triangles.reserve(static_cast<std::size_t>(surface.triangles.cols()));
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    const Eigen::Vector3i c = surface.triangles.col(t);
    triangles.emplace_back(pointOf(surface.points.col(c[0])), pointOf(surface.points.col(c[1])),
                           pointOf(surface.points.col(c[2])));
  }
  return triangles;
}

// Not parallel to axes or diagonals, so that the ray misses the edges of simple bodies.
const Kernel::Vector_3 kRay(0.3819660112501051, 0.2360679774997897, 0.8934241167);

}  // namespace

struct SurfaceDistance::Tree {
  explicit Tree(const SurfaceMesh& surface)
      : triangles(trianglesOf(surface)), tree(triangles.begin(), triangles.end()) {}

  const Triangles triangles;  // referenced by the tree
  const mesh::Tree tree;
};

SurfaceDistance::SurfaceDistance(const SurfaceMesh& surface)
    : tree_(std::make_shared<const Tree>(surface)) {}

double SurfaceDistance::operator()(const Vec3& p) const {
  return std::sqrt(tree_->tree.squared_distance(pointOf(p)));
}

bool SurfaceDistance::contains(const Vec3& p) const {
  return tree_->tree.number_of_intersected_primitives(Kernel::Ray_3(pointOf(p), kRay)) % 2 == 1;
}

Eigen::VectorXd surfaceDistances(const TetMesh& mesh, const Points& points) {
  const SurfaceDistance distance({mesh.points, boundaryTriangles(mesh.tets)});
  Eigen::VectorXd distances(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) distances[i] = distance(points.col(i));
  return distances;
}

}  // namespace palpate::mesh
