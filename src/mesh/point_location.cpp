// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/point_location.h"

#include <Eigen/LU>

namespace palpate::mesh {
namespace {

constexpr double kInside = 1e-6;  // tolerance of barycentric coordinates
constexpr int kMidnodeEdges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

Eigen::Vector4d cornerWeights(const TetMesh& mesh, Eigen::Index e, const Vec3& p) {
  Eigen::Matrix4d corners;
  for (int a = 0; a < 4; ++a) corners.col(a) << mesh.points.col(mesh.tets(a, e)), 1.0;
  return corners.inverse() * p.homogeneous();
}

// Columns dp/dw_k of a quadratic tetrahedron.
Eigen::Matrix<double, 3, 4> derivatives(const TetMesh& mesh, const Location& at) {
  Eigen::Matrix<double, 3, 4> d;
  for (int a = 0; a < 4; ++a) {
    d.col(a) = (4.0 * at.w[a] - 1.0) * mesh.points.col(mesh.tets(a, at.tet));
  }
  for (int k = 0; k < 6; ++k) {
    const auto middle = mesh.points.col(mesh.midnodes(k, at.tet));
    d.col(kMidnodeEdges[k][0]) += 4.0 * at.w[kMidnodeEdges[k][1]] * middle;
    d.col(kMidnodeEdges[k][1]) += 4.0 * at.w[kMidnodeEdges[k][0]] * middle;
  }
  return d;
}

// Newton's method for the barycentric coordinates of p in a curved tetrahedron.
void refine(const TetMesh& mesh, const Vec3& p, Location* at) {
  for (int iteration = 0; iteration < 30; ++iteration) {
    Eigen::Matrix4d J;
    J.topRows<3>() = derivatives(mesh, *at);
    J.bottomRows<1>().setOnes();
    Eigen::Vector4d residual;
    residual << p - interpolate(mesh, *at, mesh.points), 0.0;
    const Eigen::Vector4d step = J.fullPivLu().solve(residual);
    if (!step.allFinite()) return;
    at->w += step;
    if (step.norm() < 1e-14) return;
  }
}

}  // namespace

std::vector<std::pair<int, double>> shapeValues(const TetMesh& mesh, const Location& at) {
  std::vector<std::pair<int, double>> values;
  const Eigen::Vector4d& w = at.w;
  for (int a = 0; a < 4; ++a) {
    const double N = mesh.quadratic() ? w[a] * (2.0 * w[a] - 1.0) : w[a];
    values.emplace_back(mesh.tets(a, at.tet), N);
  }
  if (!mesh.quadratic()) return values;
  for (int k = 0; k < 6; ++k) {
    values.emplace_back(mesh.midnodes(k, at.tet),
                        4.0 * w[kMidnodeEdges[k][0]] * w[kMidnodeEdges[k][1]]);
  }
  return values;
}

Vec3 interpolate(const TetMesh& mesh, const Location& at, const Points& values) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [node, N] : shapeValues(mesh, at)) sum += N * values.col(node);
  return sum;
}

std::optional<Location> locate(const TetMesh& mesh, const Vec3& p) {
  Location best;
  double best_inside = -kInside;
  for (Eigen::Index e = 0; e < mesh.numTets(); ++e) {
    Location at{static_cast<int>(e), cornerWeights(mesh, e, p)};
    // Curved edges bulge by less than the tetrahedron's size.
    if (mesh.quadratic() && at.w.minCoeff() > -0.5) refine(mesh, p, &at);
    if (at.w.minCoeff() < best_inside) continue;
    best = at;
    best_inside = at.w.minCoeff();
  }
  if (best.tet < 0) return std::nullopt;
  return best;
}

}  // namespace palpate::mesh
