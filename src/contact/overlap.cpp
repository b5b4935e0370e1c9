// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "face_balls.h"
#include "palpate/contact/signed_distance.h"
#include "palpate/contact/triangle_distance.h"

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

// So deep the point of a ball may be behind a surface on which it presses [m].
constexpr double kPressed = 1e-3;
// Balls of a shape that are asked.
constexpr std::size_t kAsked = 32;

double distanceTo(const Points& x, const Eigen::Matrix3Xi& triangles, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    const TrianglePoint near = nearestOnTriangle(p, x.col(triangles(0, t)), x.col(triangles(1, t)),
                                                 x.col(triangles(2, t)));
    least = std::min(least, (near.point - p).norm());
  }
  return least;
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
  return static_cast<double>(sum / (2.0 * EIGEN_PI));  // EIGEN_PI is a long double
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

// Of a thin shape, or a round one, all over it.
std::vector<TouchBall> sunkBalls(const instrument::Geometry& geometry) {
  const double radius = inscribedRadius(geometry);
  if (radius >= kThin && !isRound(geometry)) return {{middle(geometry), radius}};
  const std::vector<TouchBall> all = faceBalls(geometry);
  const std::size_t stride = std::max<std::size_t>(1, all.size() / kAsked);
  std::vector<TouchBall> balls;
  for (std::size_t k = 0; k < all.size(); k += stride) balls.push_back(all[k]);
  return balls;
}

bool hasSunkIn(const instrument::Geometry& geometry, const Pose& X_WG, const Points& x,
               const Eigen::Matrix3Xi& triangles, double most) {
  return hasSunkIn(geometry, sunkBalls(geometry), X_WG, x, triangles, most);
}

bool hasSunkIn(const instrument::Geometry& geometry, const std::vector<TouchBall>& balls,
               const Pose& X_WG, const Points& x, const Eigen::Matrix3Xi& triangles, double most) {
  if (!overlaps(geometry, X_WG, x, triangles)) return false;
  const double radius = inscribedRadius(geometry);
  if (radius >= kThin) {
    const Pose X_GW = X_WG.inverse();
    for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const Vec3 p = X_GW * Vec3(x.col(triangles(k, t)));
        if (signedDistanceValue(geometry, p) < -most * radius) return true;
      }
    }
  }
  for (const TouchBall& ball : balls) {
    const Vec3 center = X_WG * ball.center_G;
    if (windingNumber(x, triangles, center) < 0.5) continue;
    if (distanceTo(x, triangles, center) > kPressed - ball.radius) return true;
  }
  return false;
}

}  // namespace palpate::contact
