// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/signed_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hull_distance.h"

namespace palpate::contact {
namespace {

using instrument::Box;
using instrument::Capsule;
using instrument::ConvexHull;
using instrument::Cylinder;
using instrument::SampledSurface;
using instrument::Sphere;

/// Nearer than this to a centre, an axis or an edge, the direction from it is rounding [m].
constexpr double kNoDirection = 1e-12;

/// Second derivative of |x - c| where c is fixed: (I - n n^T) / |x - c|.
Mat3 curvatureAboutPoint(const Vec3& n, double distance) {
  return (Mat3::Identity() - n * n.transpose()) / distance;
}

/// ... and where c slides along a line of direction t.
Mat3 curvatureAboutLine(const Vec3& n, const Vec3& t, double distance) {
  return (Mat3::Identity() - n * n.transpose() - t * t.transpose()) / distance;
}

Distance distance(const Sphere& sphere, const Vec3& p) {
  const double r = p.norm();
  if (!(r > kNoDirection)) return {r - sphere.radius, Vec3::UnitZ(), Mat3::Zero()};
  const Vec3 n = p / r;
  return {r - sphere.radius, n, curvatureAboutPoint(n, r)};
}

Distance distance(const Capsule& capsule, const Vec3& p) {
  const double z = std::clamp(p.z(), -capsule.half_length, capsule.half_length);
  const Vec3 from_axis(p.x(), p.y(), p.z() - z);
  const double r = from_axis.norm();
  if (!(r > kNoDirection)) return {r - capsule.radius, Vec3::UnitX(), Mat3::Zero()};
  const Vec3 n = from_axis / r;
  const bool cap = std::abs(p.z()) >= capsule.half_length;
  return {r - capsule.radius, n,
          cap ? curvatureAboutPoint(n, r) : curvatureAboutLine(n, Vec3::UnitZ(), r)};
}

// In the plane through the axis and p: a box. Its corner is the rim, which goes around the axis.
Distance distance(const Cylinder& cylinder, const Vec3& p) {
  const double r = p.head<2>().norm();
  const bool on_axis = !(r > kNoDirection);
  const Vec3 radial = on_axis ? Vec3::UnitX() : Vec3(p.x() / r, p.y() / r, 0.0);
  const Vec3 axial = (p.z() < 0.0 ? -1.0 : 1.0) * Vec3::UnitZ();
  const double wall = r - cylinder.radius, end = std::abs(p.z()) - cylinder.half_length;
  const Vec3 around = Vec3::UnitZ().cross(radial);
  const Mat3 about_axis = on_axis ? Mat3(Mat3::Zero()) : Mat3(around * around.transpose() / r);
  if (wall > 0.0 && end > 0.0) {
    const double d = Eigen::Vector2d(wall, end).norm();
    if (d > kNoDirection) {
      const Vec3 n = (wall * radial + end * axial) / d;
      const Vec3 along = (end * radial - wall * axial) / d;
      return {d, n, Mat3(along * along.transpose() / d + wall / d * about_axis)};
    }
  }
  if (end > wall) return {end, axial, Mat3::Zero()};
  return {wall, radial, about_axis};
}

Distance distance(const Box& box, const Vec3& p) {
  const Vec3 beyond = p.cwiseAbs() - box.half_extents;  // of the face of each axis
  int axis = 0;
  const double deepest = beyond.maxCoeff(&axis);
  const Vec3 face = (p[axis] < 0.0 ? -1.0 : 1.0) * Vec3::Unit(axis);
  const int outside = static_cast<int>((beyond.array() > 0.0).count());
  if (outside <= 1) return {deepest, face, Mat3::Zero()};

  Vec3 n = Vec3::Zero();
  Mat3 free = Mat3::Zero();  // projects on the axes that the nearest corner or edge is beyond
  for (int i = 0; i < 3; ++i) {
    if (!(beyond[i] > 0.0)) continue;
    n[i] = p[i] < 0.0 ? -beyond[i] : beyond[i];
    free(i, i) = 1.0;
  }
  const double d = n.norm();
  if (!(d > kNoDirection)) return {deepest, face, Mat3::Zero()};
  n /= d;
  return {d, n, (free - n * n.transpose()) / d};
}

Distance distance(const ConvexHull& hull, const Vec3& p) {
  const Nearest near = nearestOnHull(hull, p);
  Distance result{near.value, near.normal, Mat3::Zero()};
  if (near.feature == Feature::kEdge) {
    result.hessian_G = curvatureAboutLine(near.normal, near.tangent, near.value);
  } else if (near.feature == Feature::kVertex) {
    result.hessian_G = curvatureAboutPoint(near.normal, near.value);
  }
  return result;
}

Distance distance(const SampledSurface& surface, const Vec3& p) {
  const mesh::FieldPoint at = surface.grid->at(p);
  const double steepness = at.gradient.norm();
  constexpr double kFlat = 1e-9;  // without a direction
  const Vec3 normal = steepness > kFlat ? Vec3(at.gradient / steepness) : Vec3(Vec3::UnitZ());
  return {at.value, normal, at.hessian, steepness};
}

// The same values without normals and curvatures, for the many points that are only looked at.

double value(const Sphere& sphere, const Vec3& p) { return p.norm() - sphere.radius; }

double value(const Capsule& capsule, const Vec3& p) {
  const double z = std::clamp(p.z(), -capsule.half_length, capsule.half_length);
  return Vec3(p.x(), p.y(), p.z() - z).norm() - capsule.radius;
}

double value(const Cylinder& cylinder, const Vec3& p) {
  const double wall = p.head<2>().norm() - cylinder.radius;
  const double end = std::abs(p.z()) - cylinder.half_length;
  if (!(wall > 0.0 && end > 0.0)) return std::max(wall, end);
  const double d = Eigen::Vector2d(wall, end).norm();
  return d > kNoDirection ? d : std::max(wall, end);
}

double value(const Box& box, const Vec3& p) {
  const Vec3 beyond = p.cwiseAbs() - box.half_extents;
  const double d = beyond.cwiseMax(0.0).norm();
  const bool one_face = (beyond.array() > 0.0).count() <= 1;
  return one_face || !(d > kNoDirection) ? beyond.maxCoeff() : d;
}

double value(const ConvexHull& hull, const Vec3& p) { return nearestOnHull(hull, p).value; }

double value(const SampledSurface& surface, const Vec3& p) { return surface.grid->value(p); }

}  // namespace

Distance signedDistance(const instrument::Geometry& geometry, const Vec3& p_G) {
  if (p_G.hasNaN()) {
    return {std::numeric_limits<double>::quiet_NaN(), Vec3::UnitZ(), Mat3::Zero()};
  }
  return std::visit([&](const auto& shape) { return distance(shape, p_G); }, geometry);
}

double signedDistanceValue(const instrument::Geometry& geometry, const Vec3& p_G) {
  if (p_G.hasNaN()) return std::numeric_limits<double>::quiet_NaN();
  return std::visit([&](const auto& shape) { return value(shape, p_G); }, geometry);
}

}  // namespace palpate::contact
