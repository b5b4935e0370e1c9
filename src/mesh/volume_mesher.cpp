// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/volume_mesher.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "bodies.h"
#include "canonical_order.h"
#include "cgal/refine.h"
#include "palpate/base/error.h"
#include "surface_edges.h"

namespace palpate::mesh {
namespace {

constexpr double kSharpDegrees = 60.0;
constexpr double kMaxVolumeError = 0.25;  // beyond it the mesh is not the body's

[[noreturn]] void refuse(const MeshingOptions& options, const std::string& reason) {
  std::ostringstream value;
  value << options.edge_length;
  throw InputError(options.file, "edge_length", value.str(), reason);
}

Vec3 unitNormal(const SurfaceMesh& surface, int t) {
  const Eigen::Vector3i c = surface.triangles.col(t);
  const Vec3 a = surface.points.col(c[0]);
  return (surface.points.col(c[1]) - a).cross(surface.points.col(c[2]) - a).normalized();
}

/// Whether the sharp edges are edges of the body and not of its triangulation: there are some, no
/// chain of them ends in the middle of a face, and together they are long against the triangles
/// to come.
bool hasSharpNetwork(const SurfaceMesh& surface, double edge_length) {
  const double cosine = std::cos(kSharpDegrees / 180.0 * std::acos(-1.0));
  std::vector<int> sharp_at(surface.points.cols(), 0);
  double length = 0.0;
  forEachEdge(sortedEdges(surface.triangles), [&](auto first, auto last) {
    if (last - first != 2) return;
    const Vec3 a = unitNormal(surface, first->triangle);
    const Vec3 b = unitNormal(surface, (first + 1)->triangle);
    if (a.dot(b) >= cosine) return;
    ++sharp_at[first->low];
    ++sharp_at[first->high];
    length += (surface.points.col(first->low) - surface.points.col(first->high)).norm();
  });
  constexpr double kLeastEdges = 4.0;
  return length >= kLeastEdges * edge_length &&
         std::count(sharp_at.begin(), sharp_at.end(), 1) == 0;
}

bool keepsSharp(const SurfaceMesh& surface, const MeshingOptions& options) {
  if (options.sharp_edges != SharpEdges::kAuto) return options.sharp_edges == SharpEdges::kKeep;
  return hasSharpNetwork(surface, options.edge_length);
}

void refuseImpossible(const SurfaceMesh& surface, double volume, const MeshingOptions& options) {
  const double length = options.edge_length;
  if (!(length > 0.0) || !std::isfinite(length)) refuse(options, "must be a positive number [m]");
  if (!(volume > 0.0)) {
    throw InputError(options.file, "", "", "the surface must be closed and face outward");
  }
  const double size =
      (surface.points.rowwise().maxCoeff() - surface.points.rowwise().minCoeff()).maxCoeff();
  std::ostringstream text;
  if (length > 0.5 * size) {
    text << "is too large: must be at most half of the body's largest side, " << 0.5 * size << " m";
    refuse(options, text.str());
  }
  const double tets = estimateTets(volume, length);
  if (tets > kMaxTets) {
    const double least = length * std::cbrt(tets / kMaxTets);
    text << "is too small: it would make about " << tets << " tetrahedra, more than " << kMaxTets
         << "; must be at least " << least << " m for this body";
    refuse(options, text.str());
  }
}

}  // namespace

double estimateTets(double volume, double edge_length) {
  // Measured on the shipped organs: the mean tetrahedron has this part of the cube of the mean
  // edge; a regular one has 0.118.
  constexpr double kTetPerCube = 0.095;
  return volume / (kTetPerCube * edge_length * edge_length * edge_length);
}

namespace {

TetMesh meshBody(const SurfaceMesh& body, const MeshingOptions& options,
                 const MeshingProgress& progress) {
  const double volume = enclosedVolume(body);
  TetMesh mesh = cgal::refine(body, options.edge_length, keepsSharp(body, options), kSharpDegrees,
                              estimateTets(volume, options.edge_length), progress);
  if (mesh.numTets() == 0) refuse(options, "is too large: no tetrahedron fits into the body");
  orderCanonically(&mesh);

  double filled = 0.0;
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    filled += signedVolume(mesh.points, mesh.tets.col(t));
  }
  if (std::abs(filled - volume) > kMaxVolumeError * volume) {
    std::ostringstream text;
    text << "is too large: the tetrahedra fill " << 100.0 * filled / volume
         << " % of the body's volume; try half of it";
    refuse(options, text.str());
  }
  return mesh;
}

void append(TetMesh* all, const TetMesh& mesh) {
  const Eigen::Index points = all->numPoints(), tets = all->numTets();
  all->points.conservativeResize(3, points + mesh.numPoints());
  all->points.rightCols(mesh.numPoints()) = mesh.points;
  all->tets.conservativeResize(4, tets + mesh.numTets());
  all->tets.rightCols(mesh.numTets()) = mesh.tets.array() + static_cast<int>(points);
}

}  // namespace

TetMesh meshVolume(const SurfaceMesh& surface, const MeshingOptions& options,
                   const MeshingProgress& progress) {
  refuseImpossible(surface, enclosedVolume(surface), options);
  // One by one: the mesher starts from rays from the middle, and could miss a body aside.
  const std::vector<SurfaceMesh> bodies = splitBodies(surface);
  const double share = 1.0 / static_cast<double>(bodies.size());
  TetMesh all;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    MeshingProgress part;
    if (progress) {
      part = [&, i](const std::string& stage, double fraction) {
        progress(stage, share * (static_cast<double>(i) + fraction));
      };
    }
    append(&all, meshBody(bodies[i], options, part));
  }
  return all;
}

}  // namespace palpate::mesh
