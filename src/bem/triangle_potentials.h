// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::bem {

/// A flat triangle, anticlockwise about its normal.
struct Triangle {
  explicit Triangle(const Mat3& corners_by_column);

  Mat3 corners;    ///< One per column [m].
  Vec3 normal;     ///< Unit.
  double area;     ///< [m^2]
  Mat3 gradients;  ///< Gradients of the corners' linear functions, one per column [1/m].
  Vec3 middle;     ///< [m]
  double radius;   ///< Radius of the circumscribed ball about the centroid [m].
};

/// Integrals over a triangle for a point x, with r = y - x.
struct TrianglePotentials {
  double inverse;  ///< int 1/r [m]
  Mat3 pull;       ///< int r r^T / r^3 [m]; its trace is `inverse`
  Vec3 cover;      ///< int (r . n) / r^3 N_a for the linear functions N_a of the corners
};

/// In closed form, by edge integrals [Wilton et al. 1984; the others by the divergence theorem in
/// the plane], valid at any distance. For x in the triangle's plane `cover` is its principal value,
/// 0.
TrianglePotentials potentials(const Triangle& triangle, const Vec3& x);

}  // namespace palpate::bem
