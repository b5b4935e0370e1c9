// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <semaphore.h>

#include <atomic>
#include <cerrno>
#include <ctime>

#include "ros/program/throttle.h"

namespace palpate::node {

/// Tells one thread that another has heard an input. No lock: a real-time thread may tell.
class Arrivals {
 public:
  Arrivals() { sem_init(&told_, 0, 0); }
  ~Arrivals() { sem_destroy(&told_); }
  Arrivals(const Arrivals&) = delete;
  Arrivals& operator=(const Arrivals&) = delete;

  /// There is one. One thread may tell.
  void tell() {
    const Steady::rep now = Steady::now().time_since_epoch().count();
    const Steady::rep since = last_ == 0 ? 0 : now - last_;
    interval_ = interval_ == 0 ? since : interval_ + (since - interval_) / 8;
    last_ = now;
    if (!pending_.exchange(true)) sem_post(&told_);
  }
  /// When the newest came, and how often they do; 0: none did.
  Steady::time_point last() const { return Steady::time_point(Steady::duration(last_)); }
  Steady::duration interval() const { return Steady::duration(interval_); }
  /// The waiting thread: those so far are known.
  void clear() {
    if (pending_.exchange(false)) sem_wait(&told_);
  }
  bool pending() const { return pending_; }
  /// The waiting thread: until there is one, or `until`. False: there was none.
  bool wait(Steady::time_point until) {
    const auto since = until.time_since_epoch();
    const auto s = std::chrono::duration_cast<std::chrono::seconds>(since);
    const std::chrono::nanoseconds ns = since - s;
    const timespec time{static_cast<time_t>(s.count()), static_cast<long>(ns.count())};
    while (sem_clockwait(&told_, CLOCK_MONOTONIC, &time) != 0) {
      if (errno != EINTR) return false;
    }
    sem_post(&told_);  // clear() takes it back
    return true;
  }

 private:
  sem_t told_;
  std::atomic<bool> pending_{false};
  std::atomic<Steady::rep> last_{0}, interval_{0};
};

}  // namespace palpate::node
