// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/mesh/surface_mesh.h"

namespace palpate::mesh {

/// What is right and wrong with a surface, and what was mended. Edges and points are told apart
/// by index: two points in one place are two points (and a crack between the triangles there).
struct SurfaceReport {
  bool closed = false;    ///< Every edge has at least two triangles, and there is a triangle.
  bool manifold = false;  ///< Every edge has at most two triangles, every point one fan of them.
  bool oriented = false;  ///< Closed, neighbours turn alike, and the enclosed volume is positive.

  int points = 0;
  int triangles = 0;
  int components = 0;                   ///< Pieces that hang together by edges.
  int boundary_edges = 0;               ///< Edges of one triangle.
  int nonmanifold_edges = 0;            ///< Edges of three triangles and more.
  int nonmanifold_triangles = 0;        ///< Triangles at these.
  int nonmanifold_points = 0;           ///< Points where several fans of triangles touch.
  int misoriented_edges = 0;            ///< Edges that both their triangles run along alike.
  int duplicate_points = 0;             ///< Points in the place of an earlier one.
  int isolated_points = 0;              ///< Points of no triangle.
  int duplicate_triangles = 0;          ///< Triangles with the corners of an earlier one.
  int degenerate_triangles = 0;         ///< Triangles without area, see kCollapsedTriangle.
  int self_intersecting_triangles = 0;  ///< Looked for only in a manifold with alike neighbours.

  std::vector<std::string> repairs;  ///< One sentence a kind of repair, with its count.

  /// Fit for volume meshing.
  bool ok() const {
    return closed && manifold && oriented && degenerate_triangles == 0 &&
           self_intersecting_triangles == 0;
  }
};

/// A triangle counts as degenerate if its height is below this part of its longest edge.
constexpr double kCollapsedTriangle = 1e-9;

/// A hole is filled if the disc whose rim is as long as the hole's has at most this part of the
/// area of the surface.
constexpr double kMaxHoleShare = 0.01;

/// The same for the gap that is left where triangles that cut others were taken out.
constexpr double kMaxCutShare = 0.03;

/// Looks only. The surface's indices are in range and its points finite.
SurfaceReport checkSurface(const SurfaceMesh& surface);

/// Mends what can be mended without guessing, in this order: merges points in the same place,
/// removes degenerate and duplicate triangles (a neighbour takes over a corner that lies on its
/// edge), turns neighbours alike, joins open edges, fills small holes (kMaxHoleShare), replaces
/// triangles that cut others together with up to two rings of neighbours by a patch
/// (kMaxCutShare), turns the surface outward (and cavities inward), removes points of no triangle.
/// A surface in which nothing is wrong comes back as it is. `report` may be null; it describes the
/// result and what was done.
///
/// @throws InputError naming `file` if there is no triangle, an index is out of range, a
///   coordinate is not finite, or the result is open, not manifold, or cuts itself; with the
///   number of the edges and triangles.
SurfaceMesh repairSurface(const SurfaceMesh& surface, const std::string& file,
                          SurfaceReport* report = nullptr);

}  // namespace palpate::mesh
