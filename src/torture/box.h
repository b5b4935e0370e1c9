// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::torture {

/// Axis-aligned bounding box in the world frame [m].
struct Box {
  Vec3 low, high;

  void take(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  /// Distance of a point from the box [m]; 0 inside.
  double distance(const Vec3& p) const { return (p - p.cwiseMax(low).cwiseMin(high)).norm(); }
};

}  // namespace palpate::torture
