// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/haptics/wrench_fade.h"

namespace palpate::haptics {

struct WrenchFilterSettings {
  double max_force = 20.0;       ///< Bound of |F| [N].
  double max_torque = 2.0;       ///< Bound of |T| [N m].
  double max_force_rate = 2000;  ///< Bound of |dF/dt| [N/s].
  double max_torque_rate = 200;  ///< Bound of |dT/dt| [N m/s].
  double ramp = 0.1;             ///< Duration of the fade when `live` changes [s].
  double smoothing = 0.0;        ///< Time constant of the first-order low-pass [s]; 0: none.
  double max_step = 0.01;        ///< Bound of `dt`, so that a late call causes no jump [s].
};

/// Filter of the simulation's wrench for the hand, at the rate of the force loop:
///
///   target -> saturate -> low-pass -> fade (wrench_fade.h) -> limit the rate -> output
///
/// The initial gain is 0. Limits keep the directions of force and torque. Reads no clock, allocates
/// nothing.
class WrenchFilter {
 public:
  /// @throws std::invalid_argument if a limit is not finite and > 0 or a time is negative.
  explicit WrenchFilter(const WrenchFilterSettings& settings = {});

  /// Computes a tick of `dt` [s]. A target that is not finite counts as not live; a dt that is not
  /// finite and > 0 keeps the output. The result is finite and within the limits.
  /// @pre Frame and reference point are the same in every call.
  const Wrench& update(const Wrench& target, bool live, double dt);

  /// The last result.
  const Wrench& output() const { return output_; }
  /// Gain of the fade, in [0, 1].
  double gain() const { return fade_.gain(); }
  /// Resets to the state after construction, with zero output at once; for a device without a hand.
  void reset();

 private:
  WrenchFilterSettings settings_;
  Wrench smooth_;
  WrenchFade fade_;
  Wrench output_;
};

}  // namespace palpate::haptics
