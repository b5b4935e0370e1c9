// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "ros/program/throttle.h"

namespace palpate::node {

/// When cycles begin: as often as asked, on average, and where inputs come about as often, with
/// them. An input that comes as often as cycles do would else wait for a part of each, the same for
/// as long as the node runs. No clock: the caller says what time it is.
class Pace {
 public:
  Pace(Steady::duration period, Steady::time_point now) : period_(period), due_(now + period) {}

  /// A cycle begins with an input that is there from `from` on, or comes until `until`, or then
  /// without one. `afresh`: one that is there already is not waited with, for the next is near.
  struct Plan {
    Steady::time_point from, until;
    bool afresh = false;
  };
  /// `last`: when the newest input came, `interval`: how often they do; 0: none did.
  Plan next(Steady::time_point last, Steady::duration interval) const {
    Plan plan{due_, due_};
    if (interval < 0.7 * period_ || interval > 3 * period_) return plan;
    const Steady::duration patience = of(kPatience);
    plan.from -= std::min(patience, credit_);
    const Steady::time_point expected = last + interval;  // or a little later
    plan.afresh = expected >= due_ - patience && expected <= due_ + patience;
    if (plan.afresh) plan.until += patience;
    return plan;
  }

  /// A cycle began. What cycles are early is no more than one period in all; it comes back with
  /// what others are late, and else slowly.
  void began(Steady::time_point now) {
    earn(now - due_ + of(kRefund));
    due_ = now + period_;
  }
  /// A cycle ended: ticks that it covered are not made up for, but the next may be early instead,
  /// to fall into step again.
  void ended(Steady::time_point now) {
    if (now <= due_) return;
    earn(now - due_);
    due_ = now;
  }

 private:
  static constexpr double kPatience = 0.08, kRefund = 0.001;  // of a period

  Steady::duration of(double share) const {
    return std::chrono::duration_cast<Steady::duration>(share * period_);
  }
  void earn(Steady::duration time) { credit_ = std::min(credit_ + time, period_); }

  Steady::duration period_, credit_ = period_;
  Steady::time_point due_;
};

}  // namespace palpate::node
