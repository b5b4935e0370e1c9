// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

namespace palpate {

/// Runs one task at a time in a thread of its own, or without one in wait(). For tasks of many
/// cycles, which would occupy a pool thread; use ThreadPool::BackgroundTask for short ones.
class Background {
 public:
  explicit Background(bool own_thread);
  /// Waits for the running task.
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// Begins `task`. @pre It does not throw, and no other task is running.
  void begin(std::function<void()> task);
  bool underWay() const { return under_way_; }
  /// Waits for the running task. Returns false where it was done already.
  bool wait();

 private:
  struct Thread;
  std::unique_ptr<Thread> thread_;
  std::function<void()> task_;  // kept only without a thread
  bool under_way_ = false;
};

}  // namespace palpate
