// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/instrument/convex_hull.h"

#include <algorithm>
#include <stdexcept>

namespace palpate::instrument {
namespace {

/// Triangles with a smaller height over longest edge have no reliable normal.
constexpr double kNeedle = 1e-9;
constexpr double kNotConvex = 1e-6;

}  // namespace

ConvexHull makeConvexHull(const mesh::SurfaceMesh& surface) {
  const Points& points = surface.points;
  const Eigen::Index m = surface.triangles.cols();
  if (m == 0) throw std::invalid_argument("a convex hull needs triangles");
  if (!points.allFinite()) throw std::invalid_argument("a point is not finite");
  const Vec3 center = points.rowwise().mean();
  const double extent = (points.colwise() - center).colwise().norm().maxCoeff();

  ConvexHull hull{surface, Eigen::Matrix3Xd(3, m), Eigen::VectorXd(m)};
  for (Eigen::Index t = 0; t < m; ++t) {
    const Vec3 a = points.col(surface.triangles(0, t)), b = points.col(surface.triangles(1, t)),
               c = points.col(surface.triangles(2, t));
    const Vec3 twice_area = (b - a).cross(c - a);
    const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    const bool needle = !(twice_area.norm() > kNeedle * longest * longest);
    const Vec3 normal = needle ? Vec3((a + b + c) / 3.0 - center) : twice_area;
    hull.normals.col(t) = normal.normalized();
    const double through = hull.normals.col(t).dot(a);
    hull.offsets[t] = (hull.normals.col(t).transpose() * points).maxCoeff();
    if (!needle && hull.offsets[t] - through > kNotConvex * extent) {
      throw std::invalid_argument("the surface is not convex, or not oriented outward");
    }
  }
  return hull;
}

}  // namespace palpate::instrument
