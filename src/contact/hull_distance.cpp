// SPDX-License-Identifier: GPL-3.0-or-later
#include "hull_distance.h"

#include <limits>

namespace palpate::contact {
namespace {

/// Nearer than this the direction to the nearest point is rounding; the plane's normal is not [m].
constexpr double kOnSurface = 1e-12;

struct TrianglePoint {
  Vec3 point;
  Feature feature;
  Vec3 edge;  ///< Not normalised.
};

/// Nearest point of the triangle a, b, c: the seven Voronoi regions of its corners, edges and face
/// (Ericson, Real-Time Collision Detection, 2005, section 5.1.5).
TrianglePoint nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double ab_ap = ab.dot(ap), ac_ap = ac.dot(ap);
  if (ab_ap <= 0.0 && ac_ap <= 0.0) return {a, Feature::kVertex, Vec3::Zero()};
  const double ab_bp = ab.dot(bp), ac_bp = ac.dot(bp);
  if (ab_bp >= 0.0 && ac_bp <= ab_bp) return {b, Feature::kVertex, Vec3::Zero()};
  const double ab_cp = ab.dot(cp), ac_cp = ac.dot(cp);
  if (ac_cp >= 0.0 && ab_cp <= ac_cp) return {c, Feature::kVertex, Vec3::Zero()};

  // Barycentric coordinates of the projection, times twice the area squared.
  const double wc = ab_ap * ac_bp - ab_bp * ac_ap;
  if (wc <= 0.0 && ab_ap >= 0.0 && ab_bp <= 0.0) {
    return {a + ab_ap / (ab_ap - ab_bp) * ab, Feature::kEdge, ab};
  }
  const double wb = ab_cp * ac_ap - ab_ap * ac_cp;
  if (wb <= 0.0 && ac_ap >= 0.0 && ac_cp <= 0.0) {
    return {a + ac_ap / (ac_ap - ac_cp) * ac, Feature::kEdge, ac};
  }
  const double wa = ab_bp * ac_cp - ab_cp * ac_bp;
  const double along_b = ac_bp - ab_bp, along_c = ab_cp - ac_cp;
  if (wa <= 0.0 && along_b >= 0.0 && along_c >= 0.0) {
    return {b + along_b / (along_b + along_c) * (c - b), Feature::kEdge, c - b};
  }
  const double sum = wa + wb + wc;
  return {a + (wb / sum) * ab + (wc / sum) * ac, Feature::kFace, Vec3::Zero()};
}

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

  // The nearest feature belongs to a triangle whose plane is between p and the hull, and a
  // triangle is never nearer than its plane.
  double best = std::numeric_limits<double>::infinity();
  TrianglePoint nearest{p, Feature::kFace, Vec3::Zero()};
  Eigen::Index triangle = deepest;
  const auto consider = [&](Eigen::Index t) {
    const double h = hull.normals.col(t).dot(p) - hull.offsets[t];
    if (h < -plane || h >= best) return;
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
  for (Eigen::Index t = 0; t < hull.offsets.size(); ++t) {
    if (t != deepest) consider(t);
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
  return {best, normal, Feature::kEdge, nearest.edge.normalized()};
}

}  // namespace palpate::contact
