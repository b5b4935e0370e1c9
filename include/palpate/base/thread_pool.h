// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace palpate {

/// A fixed team of threads for loops whose iterations write to places of their own. Results then
/// do not depend on the size of the team; sums over iterations are the caller's, in a fixed order.
/// Helpers stay awake for some microseconds after a loop, so that short loops may follow quickly.
class ThreadPool {
 public:
  /// `threads` >= 1 counts the calling thread.
  explicit ThreadPool(int threads = 1);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const;

  /// Calls body(begin, end) on contiguous parts of [0, count), one a thread; returns when all are
  /// done. A thread that finds the team at work, or is itself in a loop of it, does all of its loop
  /// alone. `body` must not throw. Allocates nothing.
  template <class Body>
  void forRanges(std::size_t count, const Body& body) {
    run(count, {[](const void* b, std::size_t begin, std::size_t end) {
                  (*static_cast<const Body*>(b))(begin, end);
                },
                &body});
  }

 private:
  struct Team;

 public:
  /// One task at a time, which a helper does in the place of its parts of loops, so that the team
  /// never has more threads at work than it has. Without helpers, or where none has come to it
  /// yet, who waits for it does it.
  class BackgroundTask {
   public:
    explicit BackgroundTask(ThreadPool* pool);  ///< May be null; must outlive this.
    ~BackgroundTask();                          ///< Gives it up.
    BackgroundTask(const BackgroundTask&) = delete;
    BackgroundTask& operator=(const BackgroundTask&) = delete;

    /// `task` must not throw, and no other may be under way.
    void begin(std::function<void()> task);
    bool underWay() const { return under_way_; }
    void wait();
    /// Drops a task that nobody has begun with, and waits for one that is being done.
    void cancel();

   private:
    Team* team_;
    std::function<void()> task_;
    bool under_way_ = false, done_ = false;
    friend Team;
  };

 private:
  struct Loop {
    void (*call)(const void* body, std::size_t begin, std::size_t end);
    const void* body;
  };
  void run(std::size_t count, const Loop& loop);

  std::unique_ptr<Team> team_;  // null for one thread
};

}  // namespace palpate
