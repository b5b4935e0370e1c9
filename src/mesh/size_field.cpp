// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/size_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palpate::mesh {
namespace {

double distanceToSegment(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 along = b - a;
  const double length = along.squaredNorm();
  const double s = length > 0.0 ? std::clamp(along.dot(p - a) / length, 0.0, 1.0) : 0.0;
  return (a + s * along - p).norm();
}

struct DistanceToRegion {
  const Vec3& p;

  double operator()(const PlaneRegion& plane) const {
    return std::max(0.0, std::abs(p[plane.axis] - plane.at) - std::max(0.0, plane.tolerance));
  }
  double operator()(const BoxRegion& box) const {
    return (p - p.cwiseMax(box.min).cwiseMin(box.max)).norm();
  }
  double operator()(const SphereRegion& sphere) const {
    return std::max(0.0, (p - sphere.center).norm() - sphere.radius);
  }
};

struct DistanceToZone {
  const SurfaceDistance& surface;
  const Vec3& p;

  double operator()(const Polyline& line) const { return distanceTo(line, p); }
  double operator()(const Region& region) const { return distanceTo(region, p); }
  double operator()(const OwnSurface&) const { return surface(p); }
};

}  // namespace

double distanceTo(const Region& region, const Vec3& p) {
  return std::visit(DistanceToRegion{p}, region);
}

double distanceTo(const Polyline& line, const Vec3& p) {
  double least = (line.points.front() - p).norm();
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    least = std::min(least, distanceToSegment(line.points[i - 1], line.points[i], p));
  }
  return least;
}

BodySizes::BodySizes(SizeField field, const SurfaceDistance& surface)
    : field_(std::move(field)), surface_(surface) {}

double BodySizes::ofZone(std::size_t i, const Vec3& p, double shift) const {
  const RefinementZone& place = field_.near[i];
  const double distance = std::visit(DistanceToZone{surface_, p}, place.where);
  return place.finest + place.growth * std::max(0.0, distance + shift - place.radius);
}

double BodySizes::at(const Vec3& p, double shift) const {
  double size = field_.coarsest;
  for (std::size_t i = 0; i < field_.near.size(); ++i) {
    size = std::min(size, ofZone(i, p, shift));
  }
  return size;
}

}  // namespace palpate::mesh
