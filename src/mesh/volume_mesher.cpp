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
#include "meshing_checks.h"
#include "surface_edges.h"

namespace palpate::mesh {
namespace {

constexpr double kSharpDegrees = 60.0;
constexpr double kMaxVolumeError = 0.25;  // relative; refused beyond

Vec3 unitNormal(const SurfaceMesh& surface, int t) {
  const Eigen::Vector3i c = surface.triangles.col(t);
  const Vec3 a = surface.points.col(c[0]);
  return (surface.points.col(c[1]) - a).cross(surface.points.col(c[2]) - a).normalized();
}

/// Whether sharp edges belong to the body and not only to its triangulation: they exist, no chain
/// of them ends within a face, and their total length is large against the edge length.
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
  return hasSharpNetwork(surface, options.edge_length.coarsest);
}

TetMesh meshBody(const SurfaceMesh& body, const MeshingOptions& options, double expected_tets,
                 const MeshingProgress& progress) {
  const double volume = enclosedVolume(body);
  const BodySizes sizes(options.edge_length, SurfaceDistance(body));
  TetMesh mesh =
      cgal::refine(body, sizes, keepsSharp(body, options), kSharpDegrees, expected_tets, progress);
  if (mesh.numTets() == 0) {
    refuseEdgeLength(options, "is too large: no tetrahedron fits into the body");
  }
  orderCanonically(&mesh);

  double filled = 0.0;
  for (Eigen::Index t = 0; t < mesh.numTets(); ++t) {
    filled += signedVolume(mesh.points, mesh.tets.col(t));
  }
  if (std::abs(filled - volume) > kMaxVolumeError * volume) {
    std::ostringstream text;
    text << "is too large: the tetrahedra fill " << 100.0 * filled / volume
         << " % of the body's volume; try half of it";
    refuseEdgeLength(options, text.str());
  }
  return mesh;
}

void appendMesh(TetMesh* all, const TetMesh& mesh) {
  const Eigen::Index points = all->numPoints(), tets = all->numTets();
  all->points.conservativeResize(3, points + mesh.numPoints());
  all->points.rightCols(mesh.numPoints()) = mesh.points;
  all->tets.conservativeResize(4, tets + mesh.numTets());
  all->tets.rightCols(mesh.numTets()) = mesh.tets.array() + static_cast<int>(points);
}

}  // namespace

TetMesh meshVolume(const SurfaceMesh& surface, const MeshingOptions& options,
                   const MeshingProgress& progress) {
  checkMeshing(surface, options);
  // Separately, since the mesher's initial rays from the centre could miss a body.
  const std::vector<SurfaceMesh> bodies = splitBodies(surface);
  const std::vector<double> expected = expectTets(bodies, options);
  const double share = 1.0 / static_cast<double>(bodies.size());
  TetMesh all;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    MeshingProgress part;
    if (progress) {
      part = [&, i](const std::string& stage, double fraction) {
        progress(stage, share * (static_cast<double>(i) + fraction));
      };
    }
    appendMesh(&all, meshBody(bodies[i], options, expected[i], part));
  }
  return all;
}

}  // namespace palpate::mesh
