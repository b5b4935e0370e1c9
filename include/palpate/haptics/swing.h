// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "palpate/base/types.h"

namespace palpate::haptics {

/// How far something goes back and forth: along each axis the smaller of its longest rise and its
/// longest fall, so that what only creeps one way does not count.
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
  double length() const { return rise_.cwiseMin(fall_).norm(); }  ///< As added, [m].
  /// Between its farthest places, creep and all.
  double range() const { return (high_ - low_).norm(); }

 private:
  bool begun_ = false;
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero(), rise_ = Vec3::Zero(), fall_ = Vec3::Zero();
};

}  // namespace palpate::haptics
