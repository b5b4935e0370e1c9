// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "palpate/mesh/size_estimate.h"
#include "palpate/mesh/size_field.h"
#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/tet_mesh.h"

namespace palpate::mesh {

/// Whether sharp edges of the surface become edges of the tetrahedra.
enum class SharpEdges {
  kAuto,  ///< Keep them if they form a network without loose ends (a box, a cut plane), see below.
  kKeep,
  kIgnore
};

/// What the volume mesher aims at.
struct MeshingOptions {
  SizeField edge_length;                       ///< Mean edge of the tetrahedra, where they are.
  SharpEdges sharp_edges = SharpEdges::kAuto;  ///< Sharp: the normals differ by over 60 degrees.
  std::string file;                            ///< Named in error messages only.
};

/// Called now and then while meshing: what is being done, and how far the whole is, in [0, 1],
/// never decreasing.
using MeshingProgress = std::function<void(const std::string& stage, double fraction)>;

/// More tetrahedra than this are refused before meshing starts.
constexpr double kMaxTets = 2.0e6;

/// Fills a surface that passes checkSurface() with tetrahedra: Delaunay refinement, then sliver
/// perturbation and exudation (CGAL Mesh_3). Boundary points lie on the surface; the volume is a
/// little smaller where it is convex. The tetrahedra have positive volume and their boundary is
/// manifold. In each body, points are ordered along a Hilbert curve and tetrahedra by their points,
/// so that neighbours are near in memory. Deterministic: the same surface and options give the same
/// bits.
///
/// Nested closed components are cavities, separate ones separate bodies.
///
/// @throws InputError if an edge length is not a positive number, is too large for the body (no
///   tetrahedra, or their volume is far from the surface's), or too small (over kMaxTets), or if a
///   place of the size field makes nothing in the body finer.
TetMesh meshVolume(const SurfaceMesh& surface, const MeshingOptions& options,
                   const MeshingProgress& progress = {});

}  // namespace palpate::mesh
