// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace palpate {

/// A fixed team of threads for loops whose iterations write to places of their own. Results then
/// do not depend on the size of the team; sums over iterations are the caller's, in a fixed order.
class ThreadPool {
 public:
  /// `threads` >= 1 counts the calling thread.
  explicit ThreadPool(int threads = 1);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const;

  /// Calls body(begin, end) on contiguous parts of [0, count), one a thread; returns when all are
  /// done. One loop at a time. `body` must not throw.
  void forRanges(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body);

 private:
  struct Team;
  std::unique_ptr<Team> team_;  // null for one thread
};

}  // namespace palpate
