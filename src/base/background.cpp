// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/background.h"

#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

namespace palpate {

struct Background::Thread {
  std::mutex mutex;
  std::condition_variable changed;
  std::function<void()> task;
  bool busy = false, stop = false;
  std::thread thread;

  Thread() : thread([this] { work(); }) {}
  ~Thread() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      stop = true;
    }
    changed.notify_all();
    thread.join();
  }

  void work() {
    std::unique_lock<std::mutex> lock(mutex);
    for (;;) {
      changed.wait(lock, [&] { return busy || stop; });
      if (!busy) return;
      lock.unlock();
      task();
      lock.lock();
      busy = false;
      changed.notify_all();
    }
  }
};

Background::Background(bool own_thread)
    : thread_(own_thread ? std::make_unique<Thread>() : nullptr) {}

Background::~Background() = default;

void Background::begin(std::function<void()> task) {
  under_way_ = true;
  if (!thread_) {
    task_ = std::move(task);
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(thread_->mutex);
    thread_->task = std::move(task);
    thread_->busy = true;
  }
  thread_->changed.notify_all();
}

bool Background::wait() {
  if (!under_way_) return false;
  under_way_ = false;
  if (!thread_) {
    task_();
    return true;
  }
  std::unique_lock<std::mutex> lock(thread_->mutex);
  if (!thread_->busy) return false;
  thread_->changed.wait(lock, [&] { return !thread_->busy; });
  return true;
}

}  // namespace palpate
