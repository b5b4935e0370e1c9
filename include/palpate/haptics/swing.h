// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "palpate/base/types.h"

namespace palpate::haptics {

/// Amplitude of an oscillation: along each axis the smaller of longest rise and longest fall.
/// Monotonic drift does not count.
class Swing {
 public:
  void add(const Vec3& p) {
    if (!begun_) low_ = high_ = p;
    begun_ = true;
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
    rise_ = rise_.cwiseMax(p - low_);
    fall_ = fall_.cwiseMax(high_ - p);
  }
  double length() const {
    return rise_.cwiseMin(fall_).norm();
  }  ///< Norm over the axes, in the unit of add() [m].
  /// Diagonal of the bounding box of all points, with drift.
  double range() const { return (high_ - low_).norm(); }

 private:
  bool begun_ = false;
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero(), rise_ = Vec3::Zero(), fall_ = Vec3::Zero();
};

}  // namespace palpate::haptics
