// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/haptics/wrench_filter.h"

namespace palpate::haptics {

/// Limits the rate of a wrench in the frame in which it is sent, where a frame that jumps would
/// change it at once. Reads no clock, allocates nothing.
class WrenchRate {
 public:
  /// Uses the rates and max_step of `settings`.
  /// @throws std::invalid_argument if one is not finite and > 0.
  explicit WrenchRate(const WrenchFilterSettings& settings);

  /// Moves the output towards `goal` as far as the rates allow in `dt` [s].
  /// @pre `goal` is finite.
  const Wrench& follow(const Wrench& goal, double dt);
  const Wrench& output() const { return output_; }

 private:
  double max_force_rate_, max_torque_rate_, max_step_;
  Wrench output_;
};

}  // namespace palpate::haptics
