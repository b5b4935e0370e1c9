// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"
#include "palpate/haptics/wrench_filter.h"

namespace palpate::haptics {

/// A wrench that was limited in one frame and is sent in another: where that frame turns by a leap,
/// the same wrench is another one there, and must not come at once. No clock, no allocation.
class WrenchRate {
 public:
  /// Of `settings` the rates and `max_step`.
  /// @throws std::invalid_argument if one is not finite and > 0.
  explicit WrenchRate(const WrenchFilterSettings& settings);

  /// `goal`, all finite, or as near to it as `dt` [s] allows.
  const Wrench& follow(const Wrench& goal, double dt);
  const Wrench& output() const { return output_; }

 private:
  double max_force_rate_, max_torque_rate_, max_step_;
  Wrench output_;
};

}  // namespace palpate::haptics
