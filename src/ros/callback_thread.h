// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/callback_queue.h>

#include <atomic>
#include <thread>

#include "ending.h"

namespace palpate::node {

/// One thread that serves a callback queue until stop(). An exception in a callback ends the
/// program by Ending, and nothing in between.
class CallbackThread {
 public:
  CallbackThread(const char* name, ros::CallbackQueue* queue) : name_(name), queue_(*queue) {}
  ~CallbackThread() { stop(); }

  void start() {
    thread_ = std::thread([this] {
      Ending::guard(name_, [this] {
        while (!stopping_) queue_.callAvailable(ros::WallDuration(0.1));
      });
    });
  }
  void stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }

 private:
  const char* name_;
  ros::CallbackQueue& queue_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace palpate::node
