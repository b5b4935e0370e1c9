// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace palpate {

/// A fixed team of threads for loops whose iterations write to disjoint memory, so that results do
/// not depend on the number of threads. Threads spin for some microseconds after a loop, for short
/// loops in sequence.
class ThreadPool {
 public:
  /// `threads` >= 1 counts the calling thread. `for_tasks`: one more, which runs background tasks
  /// and no loops.
  explicit ThreadPool(int threads = 1, bool for_tasks = false);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const;
  /// Whether another thread than the caller of wait() can run background tasks.
  bool hasBackgroundThread() const { return team_ != nullptr; }

  /// Calls body(begin, end) on contiguous parts of [0, count), one per thread, and waits for all.
  /// Nested or concurrent calls run in the calling thread alone. Allocates nothing.
  /// @pre `body` does not throw.
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
  /// One background task at a time, run by the thread for tasks, or by one of the team instead of
  /// its parts of loops, so that the number of busy threads stays. Without a free thread, wait()
  /// runs the task.
  class BackgroundTask {
   public:
    explicit BackgroundTask(ThreadPool* pool);  ///< May be null. @pre Outlives this.
    ~BackgroundTask();                          ///< Cancels it.
    BackgroundTask(const BackgroundTask&) = delete;
    BackgroundTask& operator=(const BackgroundTask&) = delete;

    /// Begins `task`. @pre It does not throw, and no other task is running.
    void begin(std::function<void()> task);
    bool underWay() const { return under_way_; }
    void wait();
    /// Drops a task that has not begun, or waits for a running one.
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

  std::unique_ptr<Team> team_;  // null for a single thread
};

}  // namespace palpate
