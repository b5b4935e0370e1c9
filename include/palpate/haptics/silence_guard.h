// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/haptics/wrench_filter.h"

namespace palpate::haptics {

/// Stands between who computes a wrench and the device: what is heard goes on within limits, and
/// where nothing is heard any more the last wrench goes to zero and stays there; who is heard again
/// comes back by the same ramp. No clock: the caller says how much time passed since the last call.
class SilenceGuard {
 public:
  /// `patience`: so long a silence is none yet [s]; `limits.ramp`: from there to zero, and back.
  SilenceGuard(double patience, const WrenchFilterSettings& limits)
      : patience_(patience), filter_(limits) {}

  /// A wrench was heard; false: it is not finite, and counts as silence.
  bool hear(const Wrench& wrench, double dt) {
    if (!wrench.allFinite()) {
      silence_ += dt;
      return false;
    }
    silence_ = 0.0;
    update(wrench, true, held_ + dt);
    return true;
  }
  /// Nothing was heard. Whether it is time to speak for who fell silent.
  bool pass(double dt) {
    silence_ += dt;
    held_ += dt;
    if (!silent()) return false;
    update(Wrench(), false, dt);
    return true;
  }
  bool silent() const { return silence_ > patience_; }
  /// What the device is to have now.
  const Wrench& output() const { return filter_.output(); }

 private:
  void update(const Wrench& wrench, bool live, double dt) {
    filter_.update(wrench, live, dt);
    held_ = 0.0;
  }

  double patience_;
  WrenchFilter filter_;
  double silence_ = 0.0;  // since something was heard [s]
  double held_ = 0.0;     // since the output was another one [s]
};

}  // namespace palpate::haptics
