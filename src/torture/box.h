// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::torture {

/// Around points, along the world's axes [m].
struct Box {
  Vec3 low, high;

  void take(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  /// Of a point outside to it; 0 inside [m].
  double distance(const Vec3& p) const { return (p - p.cwiseMax(low).cwiseMin(high)).norm(); }
};

}  // namespace palpate::torture
