// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "palpate/contact/signed_distance.h"

namespace palpate::contact {
namespace {

using instrument::Box;
using instrument::Capsule;
using instrument::ConvexHull;
using instrument::Cylinder;
using instrument::SampledSurface;
using instrument::Sphere;

double outer(const Sphere& sphere) { return sphere.radius; }
double outer(const Capsule& capsule) { return capsule.radius + capsule.half_length; }
double outer(const Cylinder& cylinder) { return std::hypot(cylinder.radius, cylinder.half_length); }
double outer(const Box& box) { return box.half_extents.norm(); }
double outer(const ConvexHull& hull) {
  return std::sqrt(hull.surface.points.colwise().squaredNorm().maxCoeff());
}

double outer(const SampledSurface& surface) {
  return std::sqrt(surface.grid->surface.points.colwise().squaredNorm().maxCoeff());
}

double inner(const Sphere& sphere) { return sphere.radius; }
double inner(const Capsule& capsule) { return capsule.radius; }
double inner(const Cylinder& cylinder) { return std::min(cylinder.radius, cylinder.half_length); }
double inner(const Box& box) { return box.half_extents.minCoeff(); }
double inner(const ConvexHull& hull) {
  const Vec3 center = hull.surface.points.rowwise().mean();
  return std::max(0.0, (hull.offsets - hull.normals.transpose().lazyProduct(center)).minCoeff());
}
double inner(const SampledSurface& surface) { return surface.grid->inscribed_radius; }

}  // namespace

double boundingRadius(const instrument::Geometry& geometry) {
  return std::visit([](const auto& shape) { return outer(shape); }, geometry);
}

double inscribedRadius(const instrument::Geometry& geometry) {
  return std::visit([](const auto& shape) { return inner(shape); }, geometry);
}

double distanceError(const instrument::Geometry& geometry) {
  const auto* surface = std::get_if<SampledSurface>(&geometry);
  return surface ? surface->grid->largest_error : 0.0;
}

double sweepLength(const instrument::Geometry& geometry, const Pose& X_WG_begin,
                   const Pose& X_WG_end) {
  const double shift = (X_WG_end.translation() - X_WG_begin.translation()).norm();
  const double angle = Eigen::Quaterniond(X_WG_begin.linear())
                           .angularDistance(Eigen::Quaterniond(X_WG_end.linear()));
  return shift + angle * boundingRadius(geometry);
}

Pose interpolate(const Pose& begin, const Pose& end, double s) {
  if (s == 0.0) return begin;
  if (s == 1.0) return end;
  Pose X = Pose::Identity();
  X.translation() = (1.0 - s) * begin.translation() + s * end.translation();
  X.linear() = Eigen::Quaterniond(begin.linear())
                   .slerp(s, Eigen::Quaterniond(end.linear()))
                   .normalized()
                   .toRotationMatrix();
  return X;
}

}  // namespace palpate::contact
