// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace palpate {
namespace {

// A pause takes 40 to 140 cycles; all pauses take some tens of microseconds.
constexpr int kPausesAwake = 1000;

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#else
  std::atomic_signal_fence(std::memory_order_seq_cst);
#endif
}

}  // namespace

struct ThreadPool::Team {
  explicit Team(std::size_t num_parts) : parts(num_parts), taken(num_parts) {}

  std::vector<std::thread> helpers;
  std::size_t parts;

  // Written before `number`, read by threads that took a part of that loop.
  Loop loop{};
  std::size_t count = 0;
  std::atomic<std::uint64_t> number{0};           // number of the current or last loop
  std::vector<std::atomic<std::uint64_t>> taken;  // last loop in which each part was taken
  std::atomic<std::size_t> open{0};               // unfinished parts
  std::atomic<bool> stop{false};
  std::atomic<bool> at_work{false};

  std::mutex mutex;
  std::condition_variable woken, done;
  std::atomic<int> asleep{0};
  std::deque<BackgroundTask*> tasks;  // tasks that no thread has begun
  std::atomic<int> num_tasks{0};

  /// Runs a part of loop `n` unless another thread took it.
  void runPart(std::size_t part, std::uint64_t n) {
    std::uint64_t before = taken[part].load(std::memory_order_relaxed);
    if (before >= n || !taken[part].compare_exchange_strong(before, n)) return;
    const std::size_t begin = count * part / parts, end = count * (part + 1) / parts;
    if (begin < end) loop.call(loop.body, begin, end);
    open.fetch_sub(1, std::memory_order_release);
  }

  /// Returns at the next loop or task.
  std::uint64_t awaitLoopAfter(std::uint64_t last) {
    const auto called = [&] { return number.load() != last || num_tasks.load() > 0; };
    for (int k = 0; k < kPausesAwake; ++k) {
      if (called()) return number.load();
      pause();
    }
    std::unique_lock<std::mutex> lock(mutex);
    ++asleep;
    woken.wait(lock, called);
    --asleep;
    return number.load();
  }

  void add(BackgroundTask* task) {
    const std::lock_guard<std::mutex> lock(mutex);
    tasks.push_back(task);
    ++num_tasks;
    woken.notify_one();
  }

  /// Runs the first task, if any.
  void doTask() {
    std::unique_lock<std::mutex> lock(mutex);
    if (tasks.empty()) return;
    BackgroundTask* const task = tasks.front();
    tasks.pop_front();
    --num_tasks;
    lock.unlock();
    task->task_();
    lock.lock();
    task->done_ = true;
    done.notify_all();
  }

  /// Removes a task that no thread has begun; else waits for it.
  bool takeBack(BackgroundTask* task) {
    std::unique_lock<std::mutex> lock(mutex);
    const auto it = std::find(tasks.begin(), tasks.end(), task);
    if (it == tasks.end()) {
      done.wait(lock, [&] { return task->done_; });
      return false;
    }
    tasks.erase(it);
    --num_tasks;
    return true;
  }

  void help(std::size_t part) {
    for (std::uint64_t n = 0;;) {
      n = awaitLoopAfter(n);
      if (stop.load()) return;
      if (num_tasks.load() > 0) doTask();
      runPart(part, n);
    }
  }

  /// Loop of the thread for tasks, which runs no parts of loops.
  void doTasks() {
    while (!stop.load()) {
      {
        std::unique_lock<std::mutex> lock(mutex);
        woken.wait(lock, [&] { return stop.load() || num_tasks.load() > 0; });
      }
      if (!stop.load()) doTask();
    }
  }

  std::uint64_t begin() {
    const std::uint64_t n = ++number;
    if (asleep.load() == 0) return n;
    const std::lock_guard<std::mutex> lock(mutex);
    woken.notify_all();
    return n;
  }
};

ThreadPool::ThreadPool(int threads, bool for_tasks) {
  if (threads <= 1 && !for_tasks) return;
  team_ = std::make_unique<Team>(static_cast<std::size_t>(threads));
  for (std::size_t part = 1; part < team_->parts; ++part) {
    team_->helpers.emplace_back([team = team_.get(), part] { team->help(part); });
  }
  if (for_tasks) team_->helpers.emplace_back([team = team_.get()] { team->doTasks(); });
}

ThreadPool::~ThreadPool() {
  if (!team_) return;
  team_->stop = true;
  {
    const std::lock_guard<std::mutex> lock(team_->mutex);
    ++team_->number;
  }
  team_->woken.notify_all();
  for (std::thread& helper : team_->helpers) helper.join();
}

ThreadPool::BackgroundTask::BackgroundTask(ThreadPool* pool)
    : team_(pool ? pool->team_.get() : nullptr) {}

ThreadPool::BackgroundTask::~BackgroundTask() { cancel(); }

void ThreadPool::BackgroundTask::begin(std::function<void()> task) {
  task_ = std::move(task);
  under_way_ = true;
  done_ = false;
  if (team_) team_->add(this);
}

void ThreadPool::BackgroundTask::wait() {
  if (!std::exchange(under_way_, false)) return;
  if (!team_ || team_->takeBack(this)) task_();
}

void ThreadPool::BackgroundTask::cancel() {
  if (!std::exchange(under_way_, false)) return;
  if (team_) team_->takeBack(this);
}

int ThreadPool::size() const { return team_ ? static_cast<int>(team_->parts) : 1; }

void ThreadPool::run(std::size_t count, const Loop& loop) {
  if (!team_ || team_->parts == 1 || team_->at_work.exchange(true, std::memory_order_acquire)) {
    if (count > 0) loop.call(loop.body, 0, count);
    return;
  }
  team_->loop = loop;
  team_->count = count;
  team_->open.store(team_->parts, std::memory_order_relaxed);
  const std::uint64_t n = team_->begin();
  // Runs remaining parts instead of waiting for helpers without a processor.
  for (std::size_t part = 0; part < team_->parts; ++part) team_->runPart(part, n);
  for (int k = 0; team_->open.load(std::memory_order_acquire) > 0; ++k) {
    if (k < kPausesAwake) {
      pause();
    } else {
      std::this_thread::yield();  // helper in its part waits for a processor
    }
  }
  team_->at_work.store(false, std::memory_order_release);
}

}  // namespace palpate
