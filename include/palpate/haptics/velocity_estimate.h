// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "palpate/base/types.h"

namespace palpate::haptics {

/// Velocity of a device from quantised positions, which may change less often than ticks:
/// differences between changes with a first-order low-pass. Jumps are ignored. Reads no clock.
class VelocityEstimate {
 public:
  static constexpr double kSmoothing = 0.004;  ///< Time constant [s].
  static constexpr double kFastest = 2.0;      ///< Speed above which a motion is a jump [m/s].

  /// Whether a displacement `way` [m] within `time` [s] since the last change is a jump, too fast
  /// for a hand.
  static bool leaps(const Vec3& way, double time) {
    return way.norm() > kFastest * std::min(time, kStill);
  }

  /// Takes the position `p` [m] of a tick of `dt` > 0 [s].
  void update(const Vec3& p, double dt) {
    if (!begun_) p_ = p;
    begun_ = true;
    time_ += dt;
    since_leap_ += dt;
    const Vec3 way = p - p_;
    if (way == Vec3::Zero()) {
      if (time_ > kStill) v_ -= dt / (dt + kSmoothing) * v_;
      return;
    }
    const double time = std::min(time_, kStill);  // the motion may have begun just now
    if (leaps(way, time_)) {
      v_.setZero();
      since_leap_ = 0.0;
    } else {
      v_ += time / (time + kSmoothing) * (way / time - v_);
    }
    p_ = p;
    time_ = 0.0;
  }
  const Vec3& velocity() const { return v_; }       ///< [m/s]
  double sinceLeap() const { return since_leap_; }  ///< [s]

 private:
  static constexpr double kStill = 0.015;  // [s] time without a change after which the device rests

  bool begun_ = false;
  Vec3 p_ = Vec3::Zero(), v_ = Vec3::Zero();
  double time_ = 0.0;          // since the last change [s]
  double since_leap_ = 1.0e9;  // [s]
};

}  // namespace palpate::haptics
