// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/types.h"
#include "palpate/instrument/geometry.h"

namespace palpate::contact {

/// A ball with which a shape touches something rigid; a point of its surface if the radius is 0.
struct TouchBall {
  Vec3 center_G;  ///< In the shape's frame [m].
  double radius;  ///< [m]
};

/// Balls that stand for the shape's surface: of a sphere itself, of a capsule those along its axis,
/// of others points of their surface, all their corners among them. Neighbours are at most a part
/// kBallSpacing of the shape's size apart (contact::sampleSurface()).
std::vector<TouchBall> touchBalls(const instrument::Geometry& geometry);

/// Of the diagonal of the box around the shape.
constexpr double kBallSpacing = 0.04;

}  // namespace palpate::contact
