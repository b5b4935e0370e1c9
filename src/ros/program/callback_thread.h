// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/callback_queue.h>

#include <atomic>
#include <thread>

#include "realtime.h"
#include "ros/guard/ending.h"

namespace palpate::node {

/// One thread that serves a callback queue until stop(), which ends the queue, too. An exception in
/// a callback ends the program by Ending, and nothing in between.
class CallbackThread {
 public:
  /// `realtime`: at that priority, if the system lets us.
  CallbackThread(const char* name, ros::CallbackQueue* queue, bool realtime)
      : name_(name), queue_(*queue), realtime_(realtime) {}
  ~CallbackThread() { stop(); }

  void start() {
    thread_ = std::thread([this] {
      if (realtime_) becomeRealtime();
      Ending::guard(name_, [this] {
        while (!stopping_) queue_.callAvailable(ros::WallDuration(0.1));
      });
    });
  }
  void stop() {
    stopping_ = true;
    queue_.disable();  // wakes it
    if (thread_.joinable()) thread_.join();
  }

 private:
  const char* name_;
  ros::CallbackQueue& queue_;
  bool realtime_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace palpate::node
