// SPDX-License-Identifier: GPL-3.0-or-later
#include "bodies.h"

#include <Eigen/Dense>
#include <cmath>
#include <map>

#include "surface_edges.h"
#include "surface_soup.h"

namespace palpate::mesh {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Components connected by edges; each keeps all points.
std::vector<SurfaceMesh> splitPieces(const SurfaceMesh& surface) {
  UnionFind pieces(surface.triangles.cols());
  forEachEdge(sortedEdges(surface.triangles), [&](auto first, auto last) {
    for (auto use = first; use != last; ++use) pieces.join(first->triangle, use->triangle);
  });
  std::map<int, std::vector<int>> members;
  for (int t = 0; t < static_cast<int>(surface.triangles.cols()); ++t) {
    members[pieces.find(t)].push_back(t);
  }
  std::vector<SurfaceMesh> split;
  for (const auto& [root, triangles] : members) {
    SurfaceMesh piece;
    piece.points = surface.points;
    piece.triangles.resize(3, triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      piece.triangles.col(i) = surface.triangles.col(triangles[i]);
    }
    split.push_back(piece);
  }
  return split;
}

void appendPiece(SurfaceMesh* body, const SurfaceMesh& piece) {
  const Eigen::Index n = body->triangles.cols();
  body->triangles.conservativeResize(3, n + piece.triangles.cols());
  body->triangles.rightCols(piece.triangles.cols()) = piece.triangles;
}

}  // namespace

double windingNumber(const SurfaceMesh& surface, const Vec3& p) {
  double angle = 0.0;
  for (Eigen::Index t = 0; t < surface.triangles.cols(); ++t) {
    const Vec3 a = surface.points.col(surface.triangles(0, t)) - p;
    const Vec3 b = surface.points.col(surface.triangles(1, t)) - p;
    const Vec3 c = surface.points.col(surface.triangles(2, t)) - p;
    const double x = a.norm(), y = b.norm(), z = c.norm();
    angle +=
        2.0 * std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
  }
  return angle / (4.0 * kPi);
}

std::vector<SurfaceMesh> splitBodies(const SurfaceMesh& surface) {
  std::vector<SurfaceMesh> outer, cavities;
  for (const SurfaceMesh& piece : splitPieces(surface)) {
    (enclosedVolume(piece) > 0.0 ? outer : cavities).push_back(piece);
  }
  if (outer.size() <= 1) return {surface};

  std::vector<SurfaceMesh> bodies = outer;
  for (const SurfaceMesh& cavity : cavities) {
    // Bodies may lie in cavities of others, so the smallest enclosing body owns the cavity.
    int owner = -1;
    for (int i = 0; i < static_cast<int>(outer.size()); ++i) {
      const bool around = windingNumber(outer[i], cavity.points.col(cavity.triangles(0, 0))) > 0.5;
      if (around && (owner < 0 || enclosedVolume(outer[i]) < enclosedVolume(outer[owner]))) {
        owner = i;
      }
    }
    if (owner >= 0) appendPiece(&bodies[owner], cavity);
  }
  for (SurfaceMesh& body : bodies) removeIsolatedPoints(&body);
  return bodies;
}

}  // namespace palpate::mesh
