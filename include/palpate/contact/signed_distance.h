// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/instrument/geometry.h"

namespace palpate::contact {

/// Signed distance to a shape at a point, with its derivatives, in the shape's frame G.
struct Distance {
  double value;    ///< [m], negative inside.
  Vec3 normal_G;   ///< Direction of the gradient, unit, outward.
  Mat3 hessian_G;  ///< Second derivative [1/m]; zero where the nearest feature is a plane.
  /// Length of the gradient: 1, but for a sampled surface, where the nearest point changes, less.
  double steepness = 1.0;
};

/// Signed distance of the point `p_G` [m] to the shape. At points where it has no gradient (a
/// sphere's centre, a capsule's axis, a box's medial planes) one of the nearest normals is taken,
/// always the same one, so that a contact is never lost there. (The gradient of a sampled surface
/// vanishes there.) A point that is not a number has the
/// value NaN.
Distance signedDistance(const instrument::Geometry& geometry, const Vec3& p_G);

/// The value only; the same bits as signedDistance().value.
double signedDistanceValue(const instrument::Geometry& geometry, const Vec3& p_G);

/// Radius of the smallest ball about the shape's origin that holds the shape [m].
double boundingRadius(const instrument::Geometry& geometry);

/// Radius of the largest ball that fits into the shape [m] (for a hull, a lower bound): a tool
/// that moves by less than this in one go cannot jump over a point.
double inscribedRadius(const instrument::Geometry& geometry);

/// By how much a signed distance may be off [m]: zero, but for a sampled surface.
double distanceError(const instrument::Geometry& geometry);

/// Upper bound of the way [m] that any point of the shape goes between two poses of its frame.
double sweepLength(const instrument::Geometry& geometry, const Pose& X_WG_begin,
                   const Pose& X_WG_end);

/// The pose a fraction `s` in [0, 1] of the way from `begin` to `end`: position linear, rotation
/// along the great arc.
Pose interpolate(const Pose& begin, const Pose& end, double s);

}  // namespace palpate::contact
