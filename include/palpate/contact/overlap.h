// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/contact/touch_balls.h"
#include "palpate/instrument/geometry.h"

namespace palpate::contact {

/// How often the closed surface goes around the point, 1 inside and 0 outside of one that is
/// outward oriented and does not cut itself: the solid angles of its triangles, summed, over 4 pi
/// [van Oosterom, Strackee 1983, eq. 8]. `x`: points, 3 x n [m].
double windingNumber(const Points& x, const Eigen::Matrix3Xi& triangles, const Vec3& point);

/// Whether a rigid shape at X_WG touches the body with this closed surface, or comes nearer to it
/// than `margin` [m], or is inside of it, or it inside of the shape. Between the points of a
/// triangle as well; where the distance is within a tenth of the shape's inscribed radius, or a
/// hundredth of its bounding one, or its distanceError(), of the margin, it may be a yes too early.
bool overlaps(const instrument::Geometry& geometry, const Pose& X_WG, const Points& x,
              const Eigen::Matrix3Xi& triangles, double margin = 0.0);

/// Whether a shape at X_WG is deeper in the body than contact would have let it: its middle
/// or, where it is thin, any part of it behind the surface, or the surface deeper in it than
/// `most` of the way to its middle.
bool hasSunkIn(const instrument::Geometry& geometry, const Pose& X_WG, const Points& x,
               const Eigen::Matrix3Xi& triangles, double most = 0.9);
/// Balls of the shape that are asked whether they are behind the surface.
std::vector<TouchBall> sunkBalls(const instrument::Geometry& geometry);
/// The same with these given, without an allocation.
bool hasSunkIn(const instrument::Geometry& geometry, const std::vector<TouchBall>& balls,
               const Pose& X_WG, const Points& x, const Eigen::Matrix3Xi& triangles,
               double most = 0.9);

}  // namespace palpate::contact
