// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

namespace palpate {

/// One task at a time, done beside by a thread of its own, or, without one, when it is waited for:
/// for work of many cycles, which would keep a helper away from loops for as long. Short work is
/// better done by ThreadPool::BackgroundTask.
class Background {
 public:
  explicit Background(bool own_thread);
  /// Waits for the task under way.
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  /// `task` must not throw, and no other may be under way.
  void begin(std::function<void()> task);
  bool underWay() const { return under_way_; }
  /// Until the task under way is done; false if it was done already.
  bool wait();

 private:
  struct Thread;
  std::unique_ptr<Thread> thread_;
  std::function<void()> task_;  // where there is no thread
  bool under_way_ = false;
};

}  // namespace palpate
