// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "palpate/base/state_bytes.h"
#include "palpate/base/types.h"

namespace palpate::haptics {

/// Fades a wrench out when its cause is gone, after a failed solve or without input, and in again:
/// the last live wrench times a gain that is linear in time, from 1 to 0 within `ramp`. Simulation
/// cycles and force loop both use it. Reads no clock.
class WrenchFade {
 public:
  /// `ramp` >= 0 [s]; `gain`: initial gain in [0, 1].
  WrenchFade(double ramp, double gain) : ramp_(ramp), gain_(gain) {}

  /// Computes a cycle of `dt` > 0 [s]. `live`: `wrench` is valid; else it is ignored. With a gain
  /// of 1 the result equals `wrench` bitwise.
  Wrench update(const Wrench& wrench, bool live, double dt) {
    if (live) held_ = wrench;
    const double change = ramp_ > dt ? dt / ramp_ : 1.0;
    gain_ = live ? std::min(1.0, gain_ + change) : std::max(0.0, gain_ - change);
    return gain_ * held_;
  }

  void save(StateWriter* out) const {
    out->put(gain_);
    out->put(held_.force);
    out->put(held_.torque);
  }
  /// Rejects gains outside [0, 1] and wrenches above 1e6 N or N m.
  void restore(StateReader* in) {
    in->get(&gain_);
    in->get(&held_.force);
    in->get(&held_.torque);
    const bool sensible = held_.force.norm() <= kLargest && held_.torque.norm() <= kLargest;
    if (!(gain_ >= 0.0 && gain_ <= 1.0) || !sensible) StateReader::fail();
  }

  double gain() const { return gain_; }
  /// Last live wrench, without gain.
  const Wrench& held() const { return held_; }

 private:
  static constexpr double kLargest = 1e6;  // [N], [N m]

  double ramp_;
  double gain_;
  Wrench held_;
};

}  // namespace palpate::haptics
