// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace palpate::node {

using Steady = std::chrono::steady_clock;

inline Steady::duration seconds(double s) {
  return std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(s));
}
inline double inSeconds(Steady::duration d) { return std::chrono::duration<double>(d).count(); }

/// Lets one in `period` through, by the steady clock: simulated time may stand still.
class Throttle {
 public:
  explicit Throttle(double period) : period_(seconds(period)) {}

  bool due(Steady::time_point now = Steady::now()) {
    if (called_ && now - last_ < period_) return false;
    called_ = true;
    last_ = now;
    return true;
  }

 private:
  Steady::duration period_;
  Steady::time_point last_;
  bool called_ = false;
};

}  // namespace palpate::node
