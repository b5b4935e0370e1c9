// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/mesh/spline_grid.h"
#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/volume_mesher.h"

namespace palpate::mesh {

/// How finely the distance of a surface is sampled.
struct DistanceGridSettings {
  int cells = 64;         ///< Over the surface's diagonal, to begin with, >= 8;
  double error = 1.0e-4;  ///< more until no error that is found is larger [m], > 0,
  double memory = 64.0;   ///< or the grid has so many megabytes [1e6 bytes].
  /// So far beyond the surface it reaches at least [m]: for who asks with balls of that radius.
  double margin = 0.0;
};

/// Signed distance of a closed surface of any shape [m], negative inside: sampled on a grid, and
/// cubic splines between. Twice continuously differentiable in the grid's box, so the gradient is
/// shorter than 1 where the nearest point changes (at sharp edges inside, in notches outside), and
/// 1 within the error elsewhere.
///
/// Outside of the box it is the root of |p - q| squared plus the square of the distance at q, the
/// nearest point of the box: continuous, and no more than the true distance but for what the
/// splines are off at q, for the box is convex and holds the surface. Its gradient jumps at the
/// box.
struct DistanceGrid {
  SurfaceMesh surface;      ///< Whose distance it is.
  SplineGrid field;         ///< The distance.
  double largest_error;     ///< Of many points nearer to the surface than a cell [m],
  double rms_error;         ///< and the root of their mean square.
  bool limited = false;     ///< The error is larger than was asked for: memory did not allow more.
  Vec3 deepest;             ///< The node that is farthest inside,
  double inscribed_radius;  ///< and how far [m].

  double value(const Vec3& p) const;
  /// The same, with its derivatives by p; the same bits of the value.
  FieldPoint at(const Vec3& p) const;
};

/// Samples the distance of `surface`, which repairSurface() has passed. Deterministic. `progress`
/// may be empty.
/// @throws std::invalid_argument if no node of the finest grid that memory allows is inside: the
/// surface is too thin.
DistanceGrid makeDistanceGrid(const SurfaceMesh& surface, const DistanceGridSettings& settings,
                              const MeshingProgress& progress = {});

}  // namespace palpate::mesh
