// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/mesh/spline_grid.h"
#include "palpate/mesh/surface_mesh.h"
#include "palpate/mesh/volume_mesher.h"

namespace palpate::mesh {

/// Resolution of a sampled distance.
struct DistanceGridSettings {
  int cells = 64;         ///< Initial cells over the surface's diagonal, >= 8.
  double error = 1.0e-4;  ///< Largest measured error; the grid is refined until then [m], > 0.
  double memory = 64.0;   ///< Largest size of the grid [1e6 bytes].
  /// Least extent beyond the surface [m], for queries with balls of that radius.
  double margin = 0.0;
};

/// Signed distance of a closed surface [m], negative inside: cubic splines on a grid. C2 in the
/// grid's box, so the gradient's norm is below 1 where the nearest point changes (sharp edges
/// inside, notches outside), else 1 within the error.
///
/// Outside of the box it is the root of |p - q| squared plus the square of the distance at q, the
/// nearest point of the box: continuous, and no more than the true distance but for what the
/// splines are off at q, for the box is convex and holds the surface. Its gradient jumps at the
/// box.
struct DistanceGrid {
  SurfaceMesh surface;      ///< The surface.
  SplineGrid field;         ///< The distance.
  double largest_error;     ///< Largest error at points nearer to the surface than a cell [m].
  double rms_error;         ///< Root mean square error at these points [m].
  bool limited = false;     ///< Whether memory limited the error.
  Vec3 deepest;             ///< Node deepest inside.
  double inscribed_radius;  ///< Depth of that node [m].

  double value(const Vec3& p) const;
  /// The value, bitwise equal, with derivatives by p.
  FieldPoint at(const Vec3& p) const;
};

/// Samples the distance of `surface`, which repairSurface() has passed. Deterministic. `progress`
/// may be empty.
/// @throws std::invalid_argument if no node of the finest grid that memory allows is inside: the
/// surface is too thin.
DistanceGrid makeDistanceGrid(const SurfaceMesh& surface, const DistanceGridSettings& settings,
                              const MeshingProgress& progress = {});

}  // namespace palpate::mesh
