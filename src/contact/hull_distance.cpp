// SPDX-License-Identifier: GPL-3.0-or-later
#include "hull_distance.h"

#include <limits>

namespace palpate::contact {
namespace {

/// Nearer than this the direction to the nearest point is rounding; the plane's normal is not [m].
constexpr double kOnSurface = 1e-12;

}  // namespace

Nearest nearestOnHull(const instrument::ConvexHull& hull, const Vec3& p) {
  Eigen::Index deepest = 0;
  double plane = hull.normals.col(0).dot(p) - hull.offsets[0];
  for (Eigen::Index t = 1; t < hull.offsets.size(); ++t) {
    const double h = hull.normals.col(t).dot(p) - hull.offsets[t];
    if (h > plane) {
      plane = h;
      deepest = t;
    }
  }
  const Nearest on_plane{plane, hull.normals.col(deepest), Feature::kFace, Vec3::Zero()};
  if (!(plane > kOnSurface)) return on_plane;

  // The hull lies behind all planes: nothing of it is nearer than the farthest one, and what is
  // nearest belongs to a triangle that p is in front of, which is never nearer than its plane.
  double best = std::numeric_limits<double>::infinity();
  TrianglePoint nearest{p, Vec3::Zero(), Feature::kFace, 0};
  Eigen::Index triangle = deepest;
  const auto consider = [&](Eigen::Index t) {
    const double h = hull.normals.col(t).dot(p) - hull.offsets[t];
    if (!(h > 0.0) || h >= best) return;
    const Eigen::Vector3i corner = hull.surface.triangles.col(t);
    const Points& x = hull.surface.points;
    const TrianglePoint candidate =
        nearestOnTriangle(p, x.col(corner[0]), x.col(corner[1]), x.col(corner[2]));
    const double distance = (p - candidate.point).norm();
    if (distance < best) {
      best = distance;
      nearest = candidate;
      triangle = t;
    }
  };
  consider(deepest);
  if (nearest.feature != Feature::kFace) {
    for (Eigen::Index t = 0; t < hull.offsets.size(); ++t) {
      if (t != deepest) consider(t);
    }
  }
  if (!(best > kOnSurface)) return on_plane;

  // An edge between triangles of one plane is no edge: there the way to it is along the normal.
  const Vec3 normal = (p - nearest.point) / best;
  const Vec3 face_normal = hull.normals.col(triangle);
  const double rounding = 1e-9 + 1e-15 * (p.norm() + best) / best;
  if (nearest.feature == Feature::kFace || (normal - face_normal).norm() < rounding) {
    return {best, face_normal, Feature::kFace, Vec3::Zero()};
  }
  if (nearest.feature == Feature::kVertex) return {best, normal, Feature::kVertex, Vec3::Zero()};
  const Eigen::Vector3i corner = hull.surface.triangles.col(triangle);
  const Vec3 edge = hull.surface.points.col(corner[(nearest.corner + 1) % 3]) -
                    hull.surface.points.col(corner[nearest.corner]);
  return {best, normal, Feature::kEdge, edge.normalized()};
}

}  // namespace palpate::contact
