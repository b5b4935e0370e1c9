// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

namespace palpate::node {

/// Real-time priority (SCHED_FIFO) for this thread, if the system lets us, and for threads that it
/// starts from now on.
inline bool becomeRealtime(int policy = SCHED_FIFO) {
  sched_param param{};
  param.sched_priority = sched_get_priority_min(SCHED_FIFO) + 10;
  return pthread_setschedparam(pthread_self(), policy, &param) == 0;
}

/// Likewise for this thread, but in turns with others of real-time priority (SCHED_RR), where they
/// want the same core: for work that may take long. Of a lower priority it must not be if it holds
/// what the others try to get without waiting, as ROS's sending thread does.
inline bool becomeRealtimeInTurns() { return becomeRealtime(SCHED_RR); }

/// Ordinary priority for this thread.
inline void becomeOrdinary() {
  const sched_param param{};
  pthread_setschedparam(pthread_self(), SCHED_OTHER, &param);
}

/// What is started while it lives inherits real-time priority; this thread is ordinary again after.
class RealtimeScope {
 public:
  RealtimeScope() : realtime_(becomeRealtime()) {}
  ~RealtimeScope() {
    if (realtime_) becomeOrdinary();
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
