// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <variant>
#include <vector>

#include "palpate/base/types.h"

namespace palpate::mesh {

/// All points with |p[axis] - at| <= tolerance.
struct PlaneRegion {
  int axis = 2;             ///< 0 x, 1 y, 2 z.
  double at = 0.0;          ///< [m]
  double tolerance = -1.0;  ///< [m]; negative: 1e-9 of the bounding box's diagonal.
};
/// All points with min <= p <= max, component by component.
struct BoxRegion {
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();  ///< [m]
};
/// All points within `radius` of `center`.
struct SphereRegion {
  Vec3 center = Vec3::Zero();  ///< [m]
  double radius = 0.0;         ///< [m]
};
using Region = std::variant<PlaneRegion, BoxRegion, SphereRegion>;

/// Indices of the points in the region, ascending.
std::vector<int> selectPoints(const Points& points, const Region& region);

}  // namespace palpate::mesh
