// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/quality.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "palpate/base/percentiles.h"
#include "palpate/mesh/cell_mesh.h"

namespace palpate::mesh {
namespace {

constexpr int kOppositeEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
constexpr double kDegrees = 57.295779513082320877;

/// Least dihedral angle [degrees]: at edge ij, the angle between the other two corners seen along
/// the edge.
double leastDihedral(const Mat3& rest, const Vec3& origin) {
  const Vec3 corner[4] = {origin, rest.col(0), rest.col(1), rest.col(2)};
  double least = 180.0;
  for (int e = 0; e < 6; ++e) {
    const int i = kOppositeEdges[e][0], j = kOppositeEdges[e][1], k = kOppositeEdges[5 - e][0],
              l = kOppositeEdges[5 - e][1];
    const Vec3 edge = corner[j] - corner[i];
    const Vec3 a = edge.cross(corner[k] - corner[i]), b = edge.cross(corner[l] - corner[i]);
    least = std::min(least, kDegrees * std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  return least;
}

/// Circumradius of the corners 0, a, b, c: |a^2 bxc + b^2 cxa + c^2 axb| / 12 V.
double circumradius(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double six_volumes = std::abs(a.cross(b).dot(c));
  if (six_volumes == 0.0) return std::numeric_limits<double>::infinity();
  const Vec3 sum =
      a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b);
  return sum.norm() / (2.0 * six_volumes);
}

}  // namespace

TetQuality measureQuality(const TetMesh& mesh, const SurfaceMesh* reference) {
  TetQuality quality;
  if (mesh.numTets() == 0) return quality;
  std::vector<double> least;
  least.reserve(mesh.numTets());
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    const Eigen::Vector4i v = mesh.tets.col(t);
    const Vec3 origin = mesh.points.col(v[0]);
    Mat3 rest;
    for (int c = 0; c < 3; ++c) rest.col(c) = mesh.points.col(v[c + 1]) - origin;
    least.push_back(leastDihedral(rest, Vec3::Zero()));
    double shortest = std::numeric_limits<double>::infinity();
    for (const auto& e : kOppositeEdges) {
      shortest = std::min(shortest, (mesh.points.col(v[e[0]]) - mesh.points.col(v[e[1]])).norm());
    }
    const double ratio = circumradius(rest.col(0), rest.col(1), rest.col(2)) / shortest;
    quality.worst_radius_edge_ratio = std::max(quality.worst_radius_edge_ratio, ratio);
    quality.volume += signedVolume(mesh.points, v);
  }
  quality.min_dihedral_deg = quantile(least, 0.0);
  quality.median_dihedral_deg = quantile(least, 0.5);
  quality.mean_edge_length = meanEdgeLength(cellsOf(mesh));
  if (reference != nullptr) {
    const double wanted = enclosedVolume(*reference);
    quality.volume_error = (quality.volume - wanted) / wanted;
  }
  return quality;
}

}  // namespace palpate::mesh
