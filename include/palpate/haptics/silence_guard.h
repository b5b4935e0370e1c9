// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/haptics/wrench_filter.h"

namespace palpate::haptics {

/// Watchdog between the source of a wrench and the device: received wrenches pass within limits,
/// and without any the last one ramps to zero. It ramps back when the source returns. Reads no
/// clock: `dt` [s] is the time since the last call.
class SilenceGuard {
 public:
  /// `patience`: silence before the ramp begins [s]; `limits.ramp`: duration of the ramp [s].
  SilenceGuard(double patience, const WrenchFilterSettings& limits)
      : patience_(patience), filter_(limits) {}

  /// Takes a received wrench. Returns false where it is not finite, which counts as silence.
  bool hear(const Wrench& wrench, double dt) {
    if (!wrench.allFinite()) {
      silence_ += dt;
      return false;
    }
    silence_ = 0.0;
    update(wrench, true, held_ + dt);
    return true;
  }
  /// No wrench was received. Returns true where output() must be sent instead.
  bool pass(double dt) {
    silence_ += dt;
    held_ += dt;
    if (!silent()) return false;
    update(Wrench(), false, dt);
    return true;
  }
  bool silent() const { return silence_ > patience_; }
  /// Wrench for the device now.
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
