// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/types.h"

namespace palpate::springs {

/// Share of each point in a sheet or body: one third of its triangles' areas, one quarter of its
/// rectangles' areas [m^2], one quarter of its tetrahedra's volumes [m^3] [Wang 2005, 4.3.1,
/// (7.56)]. Times a density, these are the masses; their sum is the whole area or volume.
///
/// @throws std::invalid_argument naming the first triangle, rectangle or tetrahedron, counted from
/// 0, that is collapsed (below kCollapsedTriangle of its longest side) or has an unknown point.
Eigen::VectorXd triangleShares(const Points& points, const Eigen::Matrix3Xi& triangles);
/// Corners in cyclic order, 4 x m.
Eigen::VectorXd rectangleShares(const Points& points, const Eigen::Matrix4Xi& rectangles);
/// Volumes count as positive for any order of corners.
Eigen::VectorXd tetShares(const Points& points, const Eigen::Matrix4Xi& tets);

}  // namespace palpate::springs
