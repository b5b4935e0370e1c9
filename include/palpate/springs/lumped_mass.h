// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/types.h"

namespace palpate::springs {

/// What belongs to each point of a sheet or a body: one third of its triangles' areas, one quarter
/// of its rectangles' areas [m^2], one quarter of its tetrahedra's volumes [m^3] [Wang 2005, 4.3.1,
/// (7.56)]. Times a density, these are the point's mass; their sum is the whole area or volume.
///
/// @throws std::invalid_argument naming the first triangle, rectangle or tetrahedron, counted from
/// 0, that is collapsed (below kFlatTriangle of its longest side) or has a point that there is not.
Eigen::VectorXd triangleShares(const Points& points, const Eigen::Matrix3Xi& triangles);
/// Corners around the rectangle, 4 x m.
Eigen::VectorXd rectangleShares(const Points& points, const Eigen::Matrix4Xi& rectangles);
/// Volumes count as positive whichever way the corners are ordered.
Eigen::VectorXd tetShares(const Points& points, const Eigen::Matrix4Xi& tets);

}  // namespace palpate::springs
