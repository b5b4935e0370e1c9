// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/contact/touch_balls.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "circle.h"
#include "palpate/contact/surface_samples.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::contact {
namespace {

int divisionsOf(double length, double spacing) {
  return std::max(1, static_cast<int>(std::ceil(length / spacing)));
}

std::vector<TouchBall> pointsOf(const mesh::SurfaceMesh& surface) {
  const double diagonal =
      (surface.points.rowwise().maxCoeff() - surface.points.rowwise().minCoeff()).norm();
  std::vector<TouchBall> balls;
  for (const SurfaceSample& sample :
       sampleSurface(surface.points, surface.triangles, kBallSpacing * diagonal)) {
    balls.push_back({sample.position(surface.points), 0.0});
  }
  return balls;
}

std::vector<TouchBall> touchBallsOf(const instrument::Sphere& sphere) {
  return {{Vec3::Zero(), sphere.radius}};
}

std::vector<TouchBall> touchBallsOf(const instrument::Capsule& capsule) {
  if (capsule.half_length == 0.0) return {{Vec3::Zero(), capsule.radius}};
  const double diagonal = 2.0 * std::sqrt(2.0 * std::pow(capsule.radius, 2) +
                                          std::pow(capsule.radius + capsule.half_length, 2));
  const int n = divisionsOf(2.0 * capsule.half_length, kBallSpacing * diagonal);
  std::vector<TouchBall> balls;
  for (int i = 0; i <= n; ++i) {
    const double z = capsule.half_length * (2.0 * i - n) / n;
    balls.push_back({z * Vec3::UnitZ(), capsule.radius});
  }
  return balls;
}

// Rings on the wall and on the ends.
std::vector<TouchBall> touchBallsOf(const instrument::Cylinder& cylinder) {
  const double spacing =
      kBallSpacing * 2.0 *
      std::sqrt(2.0 * std::pow(cylinder.radius, 2) + std::pow(cylinder.half_length, 2));
  std::vector<TouchBall> balls;
  const auto addRing = [&](double radius, double z) {
    const int n = radius > 0.0 ? std::max(6, divisionsOf(perimeter(radius), spacing)) : 1;
    for (int i = 0; i < n; ++i) {
      const double angle = circleAngle(i, n);
      balls.push_back({Vec3(radius * std::cos(angle), radius * std::sin(angle), z), 0.0});
    }
  };
  const int along = divisionsOf(2.0 * cylinder.half_length, spacing);
  for (int i = 0; i <= along; ++i) {
    addRing(cylinder.radius, cylinder.half_length * (2.0 * i - along) / along);
  }
  const int across = divisionsOf(cylinder.radius, spacing);
  for (int i = 0; i < across; ++i) {
    for (const double z : {-cylinder.half_length, cylinder.half_length}) {
      addRing(cylinder.radius * i / across, z);
    }
  }
  return balls;
}

std::vector<TouchBall> touchBallsOf(const instrument::Box& box) {
  const mesh::TetMesh block = mesh::boxMesh(2.0 * box.half_extents, Eigen::Vector3i::Ones());
  return pointsOf({block.points.colwise() - box.half_extents, mesh::boundaryTriangles(block.tets)});
}

std::vector<TouchBall> touchBallsOf(const instrument::ConvexHull& hull) {
  return pointsOf(hull.surface);
}

std::vector<TouchBall> touchBallsOf(const instrument::SampledSurface& surface) {
  return pointsOf(surface.grid->surface);
}

}  // namespace

std::vector<TouchBall> touchBalls(const instrument::Geometry& geometry) {
  return std::visit([](const auto& shape) { return touchBallsOf(shape); }, geometry);
}

}  // namespace palpate::contact
