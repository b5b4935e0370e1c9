// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <stdexcept>
#include <vector>

namespace palpate::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Surface_mesh<Kernel::Point_3>;
constexpr double kFlat = 1e-12;

}  // namespace

SurfaceMesh convexHull(const Points& points) {
  static constexpr char kNoVolume[] =
      "the points have no convex hull with a volume: fewer than four, or all in a plane";
  if (!points.allFinite()) throw std::invalid_argument("a point is not finite");
  if (points.cols() < 4) throw std::invalid_argument(kNoVolume);
  std::vector<Kernel::Point_3> input;
  input.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    input.emplace_back(points(0, i), points(1, i), points(2, i));
  }
  const double extent =
      (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).stableNorm();  // [m]
  Polyhedron polyhedron;
  CGAL::convex_hull_3(input.begin(), input.end(), polyhedron);

  SurfaceMesh hull;
  hull.points.resize(3, static_cast<Eigen::Index>(polyhedron.number_of_vertices()));
  hull.triangles.resize(3, static_cast<Eigen::Index>(polyhedron.number_of_faces()));
  std::vector<int> index(polyhedron.number_of_vertices());
  int n = 0, m = 0;
  for (const auto v : polyhedron.vertices()) {
    const Kernel::Point_3& p = polyhedron.point(v);
    hull.points.col(n) = Vec3(p.x(), p.y(), p.z());
    index[v] = n++;
  }
  for (const auto f : polyhedron.faces()) {
    int k = 0;
    for (const auto v : polyhedron.vertices_around_face(polyhedron.halfedge(f))) {
      if (k == 3) break;
      hull.triangles(k++, m) = index[v];
    }
    if (k != 3) throw std::invalid_argument(kNoVolume);
    ++m;
  }
  if (n < 4 || m < 4 || !(enclosedVolume(hull) > kFlat * extent * extent * extent)) {
    throw std::invalid_argument(kNoVolume);
  }
  return hull;
}

}  // namespace palpate::mesh
