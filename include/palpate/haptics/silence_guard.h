// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/haptics/wrench_fade.h"

namespace palpate::haptics {

/// Stands between who computes a wrench and the device: what is heard goes on as it is, and where
/// nothing is heard any more the last wrench goes to zero and stays there. No clock: the caller
/// says how much time passes.
class SilenceGuard {
 public:
  /// `patience`: so long a silence is none yet; `ramp`: from there to zero. Both >= 0 [s].
  SilenceGuard(double patience, double ramp) : patience_(patience), fade_(ramp, 1.0), ramp_(ramp) {}

  /// A wrench was heard; false: it is not finite, and counts as silence.
  bool hear(const Wrench& wrench) {
    if (!wrench.allFinite()) return false;
    silence_ = 0.0;
    fade_ = WrenchFade(ramp_, 1.0);
    fade_.update(wrench, true, 1.0);
    return true;
  }
  /// Nothing was heard for another `dt` > 0 [s]. Whether it is time to speak for who fell silent.
  bool pass(double dt) {
    silence_ += dt;
    if (!silent()) return false;
    output_ = fade_.update(Wrench(), false, dt);
    return true;
  }
  bool silent() const { return silence_ > patience_; }
  /// Of the last pass() that was true.
  const Wrench& output() const { return output_; }

 private:
  double patience_;
  WrenchFade fade_;
  double ramp_;
  double silence_ = 0.0;
  Wrench output_;
};

}  // namespace palpate::haptics
