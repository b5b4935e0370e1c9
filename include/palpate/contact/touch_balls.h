// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/types.h"
#include "palpate/instrument/geometry.h"

namespace palpate::contact {

/// A ball of a shape for contact with a rigid surface; a surface point where the radius is 0.
struct TouchBall {
  Vec3 center_G;  ///< Centre in the shape's frame [m].
  double radius;  ///< [m]
};

/// Balls that represent a shape's surface: a sphere itself, balls along a capsule's axis, points of
/// other surfaces with all corners. Neighbours are at most kBallSpacing of the shape's size apart
/// (contact::sampleSurface()).
std::vector<TouchBall> touchBalls(const instrument::Geometry& geometry);

/// Largest ball spacing, as a fraction of the diagonal of the shape's bounding box [-].
constexpr double kBallSpacing = 0.04;

}  // namespace palpate::contact
