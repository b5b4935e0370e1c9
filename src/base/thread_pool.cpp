// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/thread_pool.h"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace palpate {

struct ThreadPool::Team {
  using Body = std::function<void(std::size_t, std::size_t)>;

  std::mutex mutex;
  std::condition_variable started, finished;
  std::vector<std::thread> helpers;
  const Body* body = nullptr;
  std::size_t count = 0;
  std::size_t loop = 0;  // number of the running loop
  std::size_t busy = 0;  // helpers still in it
  bool stop = false;

  void runPart(const Body& b, std::size_t n, std::size_t part) const {
    const std::size_t parts = helpers.size() + 1;
    const std::size_t begin = n * part / parts, end = n * (part + 1) / parts;
    if (begin < end) b(begin, end);
  }

  void help(std::size_t part) {
    std::size_t done = 0;
    for (;;) {
      std::unique_lock<std::mutex> lock(mutex);
      started.wait(lock, [&] { return stop || loop != done; });
      if (stop) return;
      done = loop;
      const Body* b = body;
      const std::size_t n = count;
      lock.unlock();
      runPart(*b, n, part);
      lock.lock();
      if (--busy == 0) finished.notify_one();
    }
  }
};

ThreadPool::ThreadPool(int threads) {
  if (threads <= 1) return;
  team_ = std::make_unique<Team>();
  // Reserved first: a helper that starts early must see the whole team's size, under the lock.
  const std::lock_guard<std::mutex> lock(team_->mutex);
  for (int part = 1; part < threads; ++part) {
    team_->helpers.emplace_back([team = team_.get(), part] { team->help(part); });
  }
}

ThreadPool::~ThreadPool() {
  if (!team_) return;
  {
    const std::lock_guard<std::mutex> lock(team_->mutex);
    team_->stop = true;
  }
  team_->started.notify_all();
  for (std::thread& helper : team_->helpers) helper.join();
}

int ThreadPool::size() const { return team_ ? static_cast<int>(team_->helpers.size()) + 1 : 1; }

void ThreadPool::forRanges(std::size_t count,
                           const std::function<void(std::size_t, std::size_t)>& body) {
  if (!team_) {
    if (count > 0) body(0, count);
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(team_->mutex);
    team_->body = &body;
    team_->count = count;
    team_->busy = team_->helpers.size();
    ++team_->loop;
  }
  team_->started.notify_all();
  team_->runPart(body, count, 0);
  std::unique_lock<std::mutex> lock(team_->mutex);
  team_->finished.wait(lock, [&] { return team_->busy == 0; });
}

}  // namespace palpate
