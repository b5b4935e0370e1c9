// SPDX-License-Identifier: GPL-3.0-or-later
#include "organ_shapes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "implicit.h"

namespace palpate::organs {
namespace {

/// 0 for x below `from`, 1 above `to`, smooth between.
double smoothStep(double x, double from, double to) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Two lobes under one dome. The underside is hollow and rises to the front, so the body gets
/// thinner towards the inferior border, with the notch of the round ligament and the bed of the
/// gallbladder.
double liver(const Vec3& p) {
  const double right = ellipsoid(p - Vec3(-0.038, 0.002, 0.012), Vec3(0.070, 0.074, 0.056));
  const double middle = ellipsoid(p - Vec3(0.012, 0.002, 0.018), Vec3(0.062, 0.062, 0.044));
  const double left = ellipsoid(p - Vec3(0.060, 0.000, 0.028), Vec3(0.054, 0.044, 0.025));
  const double dome = smoothUnion(smoothUnion(right, middle, 0.030), left, 0.035);

  // Impression of stomach, colon and kidney: a large ball subtracted from below and in front.
  const double below = (p - Vec3(0.030, -0.075, -0.170)).norm() - 0.190;
  const double hollow = smoothDifference(dome, below, 0.014);
  const double ligament = ellipsoid(p - Vec3(0.038, -0.066, 0.020), Vec3(0.006, 0.030, 0.040));
  const double notched = smoothDifference(hollow, ligament, 0.014);
  const double bed =
      taperedCapsule(p, Vec3(-0.022, -0.085, 0.010), 0.015, Vec3(-0.008, -0.015, -0.002), 0.008);
  return smoothDifference(notched, bed, 0.012);
}

/// An ellipsoid whose long axis bends towards the hilum, a dent.
double kidney(const Vec3& p) {
  constexpr double kBend = 7.0;  // [1/m]
  const Vec3 straight(p.x(), p.y() - kBend * p.x() * p.x(), p.z());
  const double bean = ellipsoid(straight, Vec3(0.0550, 0.0285, 0.0225));
  const double hilum = ellipsoid(p - Vec3(0.0, 0.032, 0.0), Vec3(0.014, 0.017, 0.009));
  return smoothDifference(bean, hilum, 0.016);
}

/// An ellipsoid that narrows from the fundus to the bent neck.
double gallbladder(const Vec3& p) {
  constexpr double kTurn = 7.0;  // [1/m]
  const double neck = std::max(p.x() - 0.010, 0.0);
  const double slim = 1.0 - 0.54 * smoothStep(p.x(), -0.020, 0.036);
  const Vec3 straight(p.x(), (p.y() - kTurn * neck * neck) / slim, p.z() / slim);
  return slim * ellipsoid(straight, Vec3(0.0450, 0.0182, 0.0182));
}

}  // namespace

mesh::SurfaceMesh makeLiver(double edge_length) {
  return meshImplicit({liver, Vec3(-0.125, -0.09, -0.06), Vec3(0.135, 0.09, 0.10)}, edge_length);
}

mesh::SurfaceMesh makeKidney(double edge_length) {
  return meshImplicit({kidney, Vec3(-0.065, -0.04, -0.03), Vec3(0.065, 0.05, 0.03)}, edge_length);
}

mesh::SurfaceMesh makeGallbladder(double edge_length) {
  return meshImplicit({gallbladder, Vec3(-0.055, -0.025, -0.025), Vec3(0.055, 0.03, 0.025)},
                      edge_length);
}

mesh::SurfaceMesh makeHollowGallbladder(double edge_length) {
  constexpr double kWall = 0.0025;  // [m]
  const auto lumen = [](const Vec3& p) { return gallbladder(p) + kWall; };
  const mesh::SurfaceMesh outer = makeGallbladder(edge_length);
  const mesh::SurfaceMesh inner =
      meshImplicit({lumen, Vec3(-0.055, -0.025, -0.025), Vec3(0.055, 0.03, 0.025)}, edge_length);
  mesh::SurfaceMesh both;
  both.points.resize(3, outer.points.cols() + inner.points.cols());
  both.points << outer.points, inner.points;
  const auto first = static_cast<int>(outer.points.cols());
  both.triangles.resize(3, outer.triangles.cols() + inner.triangles.cols());
  both.triangles << outer.triangles, (inner.triangles.array() + first).matrix().colwise().reverse();
  return both;
}

mesh::SurfaceMesh makeSlab(double edge_length) {
  const Vec3 size(0.10, 0.10, 0.03);
  const Eigen::Vector3i n = (size / edge_length).array().round().max(1.0).matrix().cast<int>();
  mesh::SurfaceMesh surface;
  std::map<std::vector<int>, int> index;
  std::vector<Vec3> points;
  std::vector<Eigen::Vector3i> triangles;
  const auto point = [&](const Eigen::Vector3i& g) {
    const auto [at, fresh] =
        index.emplace(std::vector<int>{g.x(), g.y(), g.z()}, static_cast<int>(points.size()));
    if (fresh)
      points.emplace_back(size.array() * g.cast<double>().array() / n.cast<double>().array());
    return at->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int end : {0, 1}) {
      for (int j = 0; j < n[v]; ++j) {
        for (int i = 0; i < n[u]; ++i) {
          const auto corner = [&](int di, int dj) {
            Eigen::Vector3i g;
            g[axis] = end * n[axis];
            g[u] = i + di;
            g[v] = j + dj;
            return point(g);
          };
          // Counter-clockwise as seen against the axis, then by the face's side. Diagonals
          // alternate, so the grid has no preferred direction.
          std::array<int, 4> q{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (end == 0) std::swap(q[1], q[3]);
          if ((i + j) % 2 == 0) {
            triangles.emplace_back(q[0], q[1], q[2]);
            triangles.emplace_back(q[0], q[2], q[3]);
          } else {
            triangles.emplace_back(q[0], q[1], q[3]);
            triangles.emplace_back(q[1], q[2], q[3]);
          }
        }
      }
    }
  }
  surface.points.resize(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) surface.points.col(i) = points[i];
  surface.triangles.resize(3, triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) surface.triangles.col(i) = triangles[i];
  return surface;
}

}  // namespace palpate::organs
