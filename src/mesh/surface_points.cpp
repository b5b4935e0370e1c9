// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/surface_points.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>

namespace palpate::mesh {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 trianglePoint(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

// Barycentric coordinates of a point in a triangle's plane, clamped to the triangle.
Vec3 weightsOf(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Vec3 normal = (b - a).cross(c - a);
  const double square = normal.squaredNorm();
  Vec3 w(normal.dot((c - b).cross(p - b)), normal.dot((a - c).cross(p - c)),
         normal.dot((b - a).cross(p - a)));
  if (!(square > 0.0)) return Vec3(1.0, 0.0, 0.0);
  w = (w / square).cwiseMax(0.0);
  return w / w.sum();
}

}  // namespace

std::vector<SurfacePoint> nearestSurfacePoints(const SurfaceMesh& surface, const Points& points) {
  Triangles triangles;
  triangles.reserve(static_cast<std::size_t>(surface.triangles.cols()));
  for (const auto& t : surface.triangles.colwise()) {
    triangles.emplace_back(trianglePoint(surface.points.col(t[0])),
                           trianglePoint(surface.points.col(t[1])),
                           trianglePoint(surface.points.col(t[2])));
  }
  Tree tree(triangles.begin(), triangles.end());
  std::vector<SurfacePoint> places;
  places.reserve(static_cast<std::size_t>(points.cols()));
  for (const auto& point : points.colwise()) {
    const auto [nearest, triangle] = tree.closest_point_and_primitive(trianglePoint(point));
    const Eigen::Vector3i t =
        surface.triangles.col(static_cast<Eigen::Index>(triangle - triangles.begin()));
    places.push_back(
        {t, weightsOf(surface.points.col(t[0]), surface.points.col(t[1]), surface.points.col(t[2]),
                      Vec3(nearest.x(), nearest.y(), nearest.z()))});
  }
  return places;
}

void interpolate(const std::vector<SurfacePoint>& places, const Points& values, Points* there) {
  there->resize(3, static_cast<Eigen::Index>(places.size()));
  Eigen::Index i = 0;
  for (const SurfacePoint& place : places) {
    there->col(i++) = place.weights[0] * values.col(place.nodes[0]) +
                      place.weights[1] * values.col(place.nodes[1]) +
                      place.weights[2] * values.col(place.nodes[2]);
  }
}

}  // namespace palpate::mesh
