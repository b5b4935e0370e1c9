// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "palpate/base/latest_value.h"
#include "palpate/base/percentiles.h"

namespace palpate::node {

/// Times that one thread measures and another one wants percentiles of: handed over a window at a
/// time, without a lock or an allocation on the side of the first.
class IntervalLog {
 public:
  /// The thread that measures: another time [s].
  void add(double seconds) {
    window_.times[window_.count++] = static_cast<float>(seconds);
    if (window_.count < window_.times.size()) return;
    full_.write(window_);
    window_.count = 0;
  }
  /// The other one: of the newest full window [s]; zeros before the first.
  Percentiles percentiles() {
    const Window& window = full_.read();
    std::vector<double> times(window.times.begin(),
                              window.times.begin() + static_cast<std::ptrdiff_t>(window.count));
    return palpate::percentiles(times);
  }

 private:
  struct Window {
    std::array<float, 1000> times{};
    std::size_t count = 0;
  };
  Window window_;
  LatestValue<Window> full_;
};

}  // namespace palpate::node
