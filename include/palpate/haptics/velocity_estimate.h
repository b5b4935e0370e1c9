// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::haptics {

/// How fast a device goes, from positions that its encoders quantise and that may come more seldom
/// than they are asked for: differences between changes, through a first-order low-pass. No clock.
class VelocityEstimate {
 public:
  static constexpr double kSmoothing = 0.004;  ///< Time constant [s].

  /// A tick of `dt` > 0 [s] begins with the device at `p` [m].
  void update(const Vec3& p, double dt) {
    if (!begun_) p_ = p;
    begun_ = true;
    time_ += dt;
    const Vec3 way = p - p_;
    if (way == Vec3::Zero()) {
      if (time_ > kStill) v_ -= dt / (dt + kSmoothing) * v_;
      return;
    }
    v_ += time_ / (time_ + kSmoothing) * (way / time_ - v_);
    p_ = p;
    time_ = 0.0;
  }
  const Vec3& velocity() const { return v_; }  ///< [m/s]

 private:
  static constexpr double kStill = 0.015;  // [s] so long without a change is rest

  bool begun_ = false;
  Vec3 p_ = Vec3::Zero(), v_ = Vec3::Zero();
  double time_ = 0.0;  // since the last change [s]
};

}  // namespace palpate::haptics
