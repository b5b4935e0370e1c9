// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/haptics/wrench_fade.h"

namespace palpate::haptics {

struct WrenchFilterSettings {
  double max_force = 20.0;       ///< |F| never above [N].
  double max_torque = 2.0;       ///< |T| never above [N m].
  double max_force_rate = 2000;  ///< |dF/dt| never above [N/s].
  double max_torque_rate = 200;  ///< |dT/dt| never above [N m/s].
  double ramp = 0.1;             ///< Time to come or go fully when `live` changes [s].
  double smoothing = 0.0;        ///< Time constant of the first-order low-pass [s]; 0: none.
  double max_step = 0.01;  ///< A longer `dt` counts as this, so that a late call is no jump [s].
};

/// What stands between the simulation's wrench and the hand, at the rate of the force loop.
///
///   target -> saturate -> low-pass -> fade (wrench_fade.h) -> limit the rate -> output
///
/// It comes from nothing: the fade's first gain is 0. The limits hold the direction of force and
/// torque. No clock, no allocation: the caller says how long ago the last call was.
class WrenchFilter {
 public:
  /// @throws std::invalid_argument if a limit is not finite and > 0 or a time is negative.
  explicit WrenchFilter(const WrenchFilterSettings& settings = {});

  /// One cycle of `dt` [s]. A target that is not finite counts as not live; a dt that is not
  /// finite and > 0 leaves the output. The result is always finite and within the limits.
  /// Any frame and point may be used, the same in every call.
  const Wrench& update(const Wrench& target, bool live, double dt);

  /// The last result.
  const Wrench& output() const { return output_; }
  /// 0 (gone) to 1 (fully there).
  double gain() const { return fade_.gain(); }
  /// Back to the state after construction: zero at once. For when nobody holds the device.
  void reset();

 private:
  WrenchFilterSettings settings_;
  Wrench smooth_;
  WrenchFade fade_;
  Wrench output_;
};

}  // namespace palpate::haptics
