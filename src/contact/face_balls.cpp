// SPDX-License-Identifier: GPL-3.0-or-later
#include "face_balls.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <variant>

#include "circle.h"
#include "palpate/contact/signed_distance.h"
#include "palpate/contact/surface_samples.h"

namespace palpate::contact {
namespace {

constexpr double kClosest = 5e-4;  // neighbours along edges [m]
constexpr double kOnFaces = 2e-3;  // and on faces
constexpr int kMostInLine = 400;   // so that a long needle's are no more
constexpr double kSharp = 0.94;    // cosine of the least angle between faces at an edge
// Of the radius: samples closer than that let no ball slip through between them at 2 m/s.
constexpr double kDense = 0.6;

int divisions(double length, double spacing) {
  return std::clamp(static_cast<int>(std::ceil(length / spacing - 1e-9)), 1, kMostInLine);
}

// From a to b; without these themselves.
void addBetween(const Vec3& a, const Vec3& b, double spacing, double radius,
                std::vector<TouchBall>* balls) {
  const int n = divisions((b - a).norm(), spacing);
  for (int i = 1; i < n; ++i) balls->push_back({a + (b - a) * i / n, radius});
}

void addLine(const Vec3& a, const Vec3& b, double spacing, double radius,
             std::vector<TouchBall>* balls) {
  balls->push_back({a, radius});
  if (a == b) return;
  addBetween(a, b, spacing, radius, balls);
  balls->push_back({b, radius});
}

std::vector<TouchBall> faceBallsOf(const instrument::Sphere& sphere) {
  return {{Vec3::Zero(), sphere.radius}};
}

std::vector<TouchBall> faceBallsOf(const instrument::Capsule& capsule) {
  std::vector<TouchBall> balls;
  const Vec3 end = capsule.half_length * Vec3::UnitZ();
  addLine(-end, end, std::max(capsule.radius, kClosest), capsule.radius, &balls);
  return balls;
}

std::vector<TouchBall> faceBallsOf(const instrument::Cylinder& cylinder) {
  std::vector<TouchBall> balls;
  const double r = cylinder.radius, h = cylinder.half_length;
  if (r < kThin && h > r) {
    const Vec3 end = (h - r) * Vec3::UnitZ();
    addLine(-end, end, std::max(r, kClosest), r, &balls);
  }
  const double rounding = std::min({kRounding, 0.5 * r, 0.5 * h});
  const int n = std::max(8, divisions(perimeter(r), kClosest));
  for (const double z : {rounding - h, h - rounding}) {
    for (int i = 0; i < n; ++i) {
      const double angle = circleAngle(i, n), inset = r - rounding;
      balls.push_back({Vec3(inset * std::cos(angle), inset * std::sin(angle), z), rounding});
    }
  }
  return balls;
}

// Along its edges, and on its faces if it is thin; where it is no thicker than the balls, its
// edges and faces fall together.
std::vector<TouchBall> faceBallsOf(const instrument::Box& box) {
  const double thickness = box.half_extents.minCoeff();
  const double radius = std::min(kRounding, thickness);
  const Vec3 h = (box.half_extents.array() - radius).max(0.0);
  std::vector<TouchBall> balls;
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    for (const double sb : {-h[b], h[b]}) {
      for (const double sc : {-h[c], h[c]}) {
        Vec3 from;
        from[a] = -h[a];
        from[b] = sb;
        from[c] = sc;
        Vec3 to = from;
        to[a] = h[a];
        addLine(from, to, kClosest, radius, &balls);
        if (h[c] == 0.0) break;
      }
      if (h[b] == 0.0) break;
    }
    if (thickness >= kThin) continue;
    // The two faces across a.
    const int nb = divisions(2.0 * h[b], kOnFaces), nc = divisions(2.0 * h[c], kOnFaces);
    for (int i = 1; i < nb; ++i) {
      for (int j = 1; j < nc; ++j) {
        Vec3 p;
        p[b] = h[b] * (2.0 * i - nb) / nb;
        p[c] = h[c] * (2.0 * j - nc) / nc;
        for (const double z : {-h[a], h[a]}) {
          p[a] = z;
          balls.push_back({p, radius});
          if (h[a] == 0.0) break;
        }
      }
    }
  }
  return balls;
}

// At p of the surface, with the outward normal n: as far inside that it touches from within.
void addInside(const instrument::Geometry& geometry, const Vec3& p, const Vec3& n,
               std::vector<TouchBall>* balls) {
  const double rounding = std::min(kRounding, 0.5 * inscribedRadius(geometry));
  const Vec3 center = p - rounding * n;
  const double depth = -signedDistanceValue(geometry, center);
  if (depth > 0.0) {
    balls->push_back({center, depth});
  } else {
    balls->push_back({p, 0.0});
  }
}

Vec3 normalOf(const mesh::SurfaceMesh& surface, const Eigen::Vector3i& t) {
  const Vec3 a = surface.points.col(t[0]), b = surface.points.col(t[1]),
             c = surface.points.col(t[2]);
  return (b - a).cross(c - a).normalized();
}

// Along its sharp edges, and all over it where it is thin.
std::vector<TouchBall> faceBallsOf(const instrument::Geometry& geometry,
                                   const mesh::SurfaceMesh& surface) {
  const double diagonal =
      (surface.points.rowwise().maxCoeff() - surface.points.rowwise().minCoeff()).norm();
  std::vector<TouchBall> balls;
  if (inscribedRadius(geometry) < kThin) {
    const double spacing = std::max(kOnFaces, kBallSpacing * diagonal);
    for (const SurfaceSample& s : sampleSurface(surface.points, surface.triangles, spacing)) {
      addInside(geometry, s.position(surface.points), normalOf(surface, s.nodes), &balls);
    }
  }
  std::map<std::pair<int, int>, Vec3> beside;
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    const Eigen::Vector3i nodes = surface.triangles.col(t);
    const Vec3 n = normalOf(surface, nodes);
    for (int k = 0; k < 3; ++k) {
      const int from = nodes[k], to = nodes[(k + 1) % 3];
      const auto [other, fresh] = beside.emplace(std::minmax(from, to), n);
      if (fresh || other->second.dot(n) > kSharp) continue;
      const Vec3 p = surface.points.col(from), q = surface.points.col(to);
      const int parts = divisions((q - p).norm(), kClosest);
      for (int i = 0; i <= parts; ++i) {
        addInside(geometry, p + (q - p) * i / parts, (other->second + n).normalized(), &balls);
      }
    }
  }
  return balls;
}

}  // namespace

std::vector<TouchBall> faceBalls(const instrument::Geometry& geometry) {
  if (const auto* hull = std::get_if<instrument::ConvexHull>(&geometry)) {
    return faceBallsOf(geometry, hull->surface);
  }
  if (const auto* sampled = std::get_if<instrument::SampledSurface>(&geometry)) {
    return faceBallsOf(geometry, sampled->grid->surface);
  }
  if (const auto* sphere = std::get_if<instrument::Sphere>(&geometry)) return faceBallsOf(*sphere);
  if (const auto* capsule = std::get_if<instrument::Capsule>(&geometry))
    return faceBallsOf(*capsule);
  if (const auto* box = std::get_if<instrument::Box>(&geometry)) return faceBallsOf(*box);
  return faceBallsOf(std::get<instrument::Cylinder>(geometry));
}

bool isRound(const instrument::Geometry& geometry) {
  return std::holds_alternative<instrument::Sphere>(geometry) ||
         std::holds_alternative<instrument::Capsule>(geometry);
}

bool coverAll(const instrument::Geometry& geometry) {
  return isRound(geometry) || inscribedRadius(geometry) < kThin;
}

double resolutionOf(const instrument::Geometry& geometry) {
  const double radius = inscribedRadius(geometry);
  return isRound(geometry) ? kDense * radius : std::min(kDense * radius, kThin);
}

}  // namespace palpate::contact
