// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/instrument/geometry.h"

namespace palpate::contact {

/// Signed distance of a point from a shape, with derivatives, in the shape's frame G.
struct Distance {
  double value;    ///< [m], negative inside.
  Vec3 normal_G;   ///< Direction of the gradient, unit, outward.
  Mat3 hessian_G;  ///< Second derivative [1/m]; zero where the nearest feature is a plane.
  /// Norm of the gradient [-]; less than 1 on a sampled surface where the nearest point changes.
  double steepness = 1.0;
};

/// Signed distance of the point `p_G` [m] to the shape. Where the gradient does not exist (a
/// sphere's centre, a capsule's axis, a box's medial planes) the normal is a fixed one of the
/// nearest. The gradient of a sampled surface vanishes there. NaN for a point that is not finite.
Distance signedDistance(const instrument::Geometry& geometry, const Vec3& p_G);

/// The value alone, bitwise equal to signedDistance().value.
double signedDistanceValue(const instrument::Geometry& geometry, const Vec3& p_G);

/// Radius of the smallest ball about the shape's origin that holds the shape [m].
double boundingRadius(const instrument::Geometry& geometry);

/// Radius of the largest ball inside the shape [m]; for a hull a lower bound. A tool that moves by
/// less does not pass over a point.
double inscribedRadius(const instrument::Geometry& geometry);

/// Error bound of the signed distance [m]; zero except for a sampled surface.
double distanceError(const instrument::Geometry& geometry);

/// Upper bound of the displacement of any point of the shape between two poses [m].
double sweepLength(const instrument::Geometry& geometry, const Pose& X_WG_begin,
                   const Pose& X_WG_end);

/// Pose at fraction `s` in [0, 1] from `begin` to `end`: linear position, slerp of the rotation.
Pose interpolate(const Pose& begin, const Pose& end, double s);

}  // namespace palpate::contact
