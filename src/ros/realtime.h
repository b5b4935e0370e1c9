// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

namespace palpate::node {

/// Real-time priority (SCHED_FIFO) for this thread, if the system lets us, and for threads that it
/// starts from now on.
inline bool becomeRealtime() {
  sched_param param{};
  param.sched_priority = sched_get_priority_min(SCHED_FIFO) + 10;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) == 0;
}

/// What is started while it lives inherits real-time priority; this thread is ordinary again after.
class RealtimeScope {
 public:
  RealtimeScope() : realtime_(becomeRealtime()) {}
  ~RealtimeScope() {
    const sched_param param{};
    if (realtime_) pthread_setschedparam(pthread_self(), SCHED_OTHER, &param);
  }
  RealtimeScope(const RealtimeScope&) = delete;
  RealtimeScope& operator=(const RealtimeScope&) = delete;
  bool isRealtime() const { return realtime_; }

 private:
  bool realtime_;
};

/// Keeps all memory that the process uses in RAM, from its first use on, if the system lets us.
inline bool lockMemory() { return mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0; }

}  // namespace palpate::node
