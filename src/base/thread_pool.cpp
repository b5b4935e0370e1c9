// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/thread_pool.h"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace palpate {
namespace {

// A pause takes 40 to 140 cycles: some tens of microseconds in all.
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
  std::vector<std::thread> helpers;
  std::size_t parts = 1;

  // Written before `number` is, read after.
  Loop loop{};
  std::size_t count = 0;
  std::atomic<std::uint64_t> number{0};  // of the loop that runs or ran last
  std::atomic<std::size_t> busy{0};      // helpers still in it
  std::atomic<bool> stop{false};
  std::atomic<bool> taken{false};  // a loop is under way

  std::mutex mutex;
  std::condition_variable woken;
  std::atomic<int> asleep{0};

  void runPart(std::size_t part) const {
    const std::size_t begin = count * part / parts, end = count * (part + 1) / parts;
    if (begin < end) loop.call(loop.body, begin, end);
  }

  void awaitLoopAfter(std::uint64_t last) {
    for (int k = 0; k < kPausesAwake; ++k) {
      if (number.load(std::memory_order_acquire) != last) return;
      pause();
    }
    std::unique_lock<std::mutex> lock(mutex);
    ++asleep;
    woken.wait(lock, [&] { return number.load() != last; });
    --asleep;
  }

  void help(std::size_t part) {
    for (std::uint64_t last = 0;; ++last) {
      awaitLoopAfter(last);
      if (stop.load()) return;
      runPart(part);
      busy.fetch_sub(1, std::memory_order_release);
    }
  }

  void begin() {
    ++number;
    if (asleep.load() == 0) return;
    const std::lock_guard<std::mutex> lock(mutex);
    woken.notify_all();
  }
};

ThreadPool::ThreadPool(int threads) {
  if (threads <= 1) return;
  team_ = std::make_unique<Team>();
  team_->parts = static_cast<std::size_t>(threads);
  for (std::size_t part = 1; part < team_->parts; ++part) {
    team_->helpers.emplace_back([team = team_.get(), part] { team->help(part); });
  }
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

int ThreadPool::size() const { return team_ ? static_cast<int>(team_->parts) : 1; }

void ThreadPool::run(std::size_t count, const Loop& loop) {
  if (!team_ || team_->taken.exchange(true, std::memory_order_acquire)) {
    if (count > 0) loop.call(loop.body, 0, count);
    return;
  }
  team_->loop = loop;
  team_->count = count;
  team_->busy.store(team_->helpers.size(), std::memory_order_relaxed);
  team_->begin();
  team_->runPart(0);
  for (int k = 0; team_->busy.load(std::memory_order_acquire) > 0; ++k) {
    if (k < kPausesAwake) {
      pause();
    } else {
      std::this_thread::yield();  // the helper waits for a processor
    }
  }
  team_->taken.store(false, std::memory_order_release);
}

}  // namespace palpate
