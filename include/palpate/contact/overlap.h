// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/contact/touch_balls.h"
#include "palpate/instrument/geometry.h"

namespace palpate::contact {

/// Winding number of a closed surface around a point: 1 inside, 0 outside of an outward surface
/// without self-intersection. Sum of the triangles' solid angles over 4 pi [van Oosterom, Strackee
/// 1983, eq. 8]. `x`: points, 3 x n [m].
double windingNumber(const Points& x, const Eigen::Matrix3Xi& triangles, const Vec3& point);

/// Whether a rigid shape at X_WG is nearer to a body's closed surface than `margin` [m], or one
/// contains the other. Conservative by a tenth of the inscribed radius, a hundredth of the bounding
/// radius, or distanceError().
bool overlaps(const instrument::Geometry& geometry, const Pose& X_WG, const Points& x,
              const Eigen::Matrix3Xi& triangles, double margin = 0.0);

/// Whether a shape at X_WG is deeper in a body than contact allows: its middle, or any part of a
/// thin shape, is behind the surface, or the penetration exceeds `most` of the inscribed radius.
bool hasSunkIn(const instrument::Geometry& geometry, const Pose& X_WG, const Points& x,
               const Eigen::Matrix3Xi& triangles, double most = 0.9);
/// Balls of the shape that hasSunkIn() tests against the surface.
std::vector<TouchBall> sunkBalls(const instrument::Geometry& geometry);
/// The same with given sunkBalls(), without allocation.
bool hasSunkIn(const instrument::Geometry& geometry, const std::vector<TouchBall>& balls,
               const Pose& X_WG, const Points& x, const Eigen::Matrix3Xi& triangles,
               double most = 0.9);

}  // namespace palpate::contact
