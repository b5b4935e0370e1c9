// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "palpate/base/state_bytes.h"
#include "palpate/base/types.h"

namespace palpate::haptics {

/// How a wrench goes when its cause is gone, because a solve failed or no input comes, and how it
/// comes back: the last one that had a cause is held, times a gain that runs linearly in time
/// between 1 (there) and 0 (gone), the whole way in `ramp`. The one such rule: the simulation's
/// cycles and the force loop both use it. No clock: the caller says how much time passes.
class WrenchFade {
 public:
  /// `ramp` >= 0 [s]; `gain` in [0, 1] is the first one.
  WrenchFade(double ramp, double gain) : ramp_(ramp), gain_(gain) {}

  /// A cycle of `dt` > 0 [s]. `live`: `wrench` has its cause now; else it is not looked at. With a
  /// gain of 1 it comes back as it is, bit for bit.
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
  /// Refuses what no hand has felt.
  void restore(StateReader* in) {
    in->get(&gain_);
    in->get(&held_.force);
    in->get(&held_.torque);
    const bool sensible = held_.force.norm() <= kLargest && held_.torque.norm() <= kLargest;
    if (!(gain_ >= 0.0 && gain_ <= 1.0) || !sensible) StateReader::fail();
  }

  double gain() const { return gain_; }
  /// The last wrench that was live, whole.
  const Wrench& held() const { return held_; }

 private:
  static constexpr double kLargest = 1e6;  // [N], [N m]

  double ramp_;
  double gain_;
  Wrench held_;
};

}  // namespace palpate::haptics
