// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "ros/program/throttle.h"

namespace palpate::node {

/// Lengths of the live steps, in cycles: a step covers the time since the step before began, so
/// that simulated time keeps up with real time where cycles are late. Reads no clock.
class StepLength {
 public:
  /// `most`: most cycles of `period` that one step covers; 1: simulated time slows down instead.
  StepLength(Steady::duration period, int most) : period_(inSeconds(period)), most_(most) {}

  /// Returns the number of cycles, 1 to `most`, of a step that begins at `now`.
  int begin(Steady::time_point now) {
    if (last_) owed_ += inSeconds(now - *last_) / period_;
    if (!last_) owed_ = 1.0;
    last_ = now;
    const int cycles = std::clamp(static_cast<int>(std::lround(std::min(owed_, 1e6))), 1, most_);
    owed_ = std::clamp(owed_ - cycles, -kMostCarried, kMostCarried);
    return cycles;
  }
  /// No step is due: the time until the next one does not count.
  void pause() { last_.reset(); }

 private:
  static constexpr double kMostCarried = 0.5;  // cycles that are left to the next step

  double period_;
  int most_;
  std::optional<Steady::time_point> last_;
  double owed_ = 0.0;  // simulated time behind real time, in cycles
};

}  // namespace palpate::node
