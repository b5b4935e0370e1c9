// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/overlap.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "palpate/contact/signed_distance.h"

namespace palpate::contact {
namespace {

// A point in the shape's interior, in its frame.
Vec3 middle(const instrument::Geometry& geometry) {
  if (const auto* surface = std::get_if<instrument::SampledSurface>(&geometry)) {
    return surface->grid->deepest;
  }
  const auto* hull = std::get_if<instrument::ConvexHull>(&geometry);
  return hull ? Vec3(hull->surface.points.rowwise().mean()) : Vec3(Vec3::Zero());
}

// Whether the triangle with these corners, in the shape's frame, comes nearer than `margin`. The
// distance changes by no more than the way: a triangle that could be nearer is cut into four, as
// long as its points are more than `enough` from its middle.
bool comesNearer(const instrument::Geometry& geometry, const Mat3& corners, double margin,
                 double enough) {
  const Vec3 center = corners.rowwise().mean();
  const double distance = signedDistanceValue(geometry, center);
  if (distance < margin) return true;
  const double radius = std::sqrt((corners.colwise() - center).colwise().squaredNorm().maxCoeff());
  if (distance - radius >= margin) return false;
  if (radius <= enough) return true;
  Mat3 halves;  // of the edge from corner k on
  for (int k = 0; k < 3; ++k) halves.col(k) = 0.5 * (corners.col(k) + corners.col((k + 1) % 3));
  if (comesNearer(geometry, halves, margin, enough)) return true;
  for (int k = 0; k < 3; ++k) {
    Mat3 part;
    part << corners.col(k), halves.col(k), halves.col((k + 2) % 3);
    if (comesNearer(geometry, part, margin, enough)) return true;
  }
  return false;
}

}  // namespace

double windingNumber(const Points& x, const Eigen::Matrix3Xi& triangles, const Vec3& point) {
  double sum = 0.0;  // of half the solid angles
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const Vec3 a = x.col(triangles(0, t)) - point, b = x.col(triangles(1, t)) - point,
               c = x.col(triangles(2, t)) - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2.0 * EIGEN_PI);
}

bool overlaps(const instrument::Geometry& geometry, const Pose& X_WG, const Points& x,
              const Eigen::Matrix3Xi& triangles, double margin) {
  if (triangles.cols() == 0) return false;
  margin += distanceError(geometry);
  const double reach = boundingRadius(geometry) + margin;
  const Vec3 low = x.rowwise().minCoeff(), high = x.rowwise().maxCoeff();
  const Vec3 origin = X_WG.translation();
  if ((origin.array() + reach < low.array()).any() ||
      (origin.array() - reach > high.array()).any()) {
    return false;
  }
  const Pose X_GW = X_WG.inverse();
  // A flat hull has no inside.
  const double enough = std::max(0.1 * inscribedRadius(geometry), 0.01 * boundingRadius(geometry));
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    Mat3 corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = X_GW * Vec3(x.col(triangles(k, t)));
    const Vec3 nearest =
        corners.rowwise().minCoeff().cwiseMax(0.0) + corners.rowwise().maxCoeff().cwiseMin(0.0);
    if (nearest.norm() > reach) continue;  // of its bounding box, to the origin
    if (comesNearer(geometry, corners, margin, enough)) return true;
  }
  // The surfaces are apart: all of the shape is on one side.
  return windingNumber(x, triangles, X_WG * middle(geometry)) > 0.5;
}

}  // namespace palpate::contact
