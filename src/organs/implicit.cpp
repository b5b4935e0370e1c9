// SPDX-License-Identifier: GPL-3.0-or-later
#include "implicit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "palpate/mesh/remesh.h"

namespace palpate::organs {
namespace {

constexpr double kMinSpacing = 1e-3, kMaxSpacing = 3e-3;  // [m] of the grid
constexpr int kRemeshingRounds = 8;

Vec3 gradient(const ImplicitBody& body, const Vec3& p) {
  constexpr double kStep = 1e-6;  // [m]
  Vec3 g;
  for (int k = 0; k < 3; ++k) {
    const Vec3 d = kStep * Vec3::Unit(k);
    g[k] = (body.value(p + d) - body.value(p - d)) / (2.0 * kStep);
  }
  return g;
}

/// Newton steps along the gradient, each at most `reach` [m].
Vec3 project(const ImplicitBody& body, Vec3 p, double reach) {
  constexpr int kSteps = 4;
  for (int step = 0; step < kSteps; ++step) {
    const Vec3 g = gradient(body, p);
    const double length = std::abs(body.value(p)) / g.norm();
    if (!(length > 0.0)) break;
    p -= std::min(1.0, reach / length) * body.value(p) * g / g.squaredNorm();
  }
  return p;
}

}  // namespace

double ellipsoid(const Vec3& p, const Vec3& radii) {
  const Vec3 q = p.cwiseQuotient(radii);
  const double slope = q.cwiseQuotient(radii).norm();
  if (slope == 0.0) return -radii.minCoeff();
  return q.norm() * (q.norm() - 1.0) / slope;
}

double taperedCapsule(const Vec3& p, const Vec3& a, double ra, const Vec3& b, double rb) {
  const Vec3 axis = b - a;
  const double t = std::clamp((p - a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  return (p - a - t * axis).norm() - (ra + t * (rb - ra));
}

double smoothUnion(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - h * h * h * blend / 6.0;
}

double smoothDifference(double a, double b, double blend) { return -smoothUnion(-a, b, blend); }

mesh::SurfaceMesh meshImplicit(const ImplicitBody& body, double edge_length) {
  const double spacing = std::clamp(0.5 * edge_length, kMinSpacing, kMaxSpacing);
  mesh::SurfaceMesh surface =
      mesh::remesh(marchTetrahedra(body, spacing), edge_length, kRemeshingRounds);
  for (Eigen::Index i = 0; i < surface.points.cols(); ++i) {
    surface.points.col(i) = project(body, surface.points.col(i), 0.2 * edge_length);
  }
  return surface;
}

}  // namespace palpate::organs
