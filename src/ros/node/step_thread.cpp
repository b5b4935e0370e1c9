// SPDX-License-Identifier: GPL-3.0-or-later
#include "step_thread.h"

#include "ros/guard/ending.h"

namespace palpate::node {
namespace {

constexpr double kLong = 0.2;  // [s] of a step

}  // namespace

StepThread::StepThread(sim::Simulator* simulator) : simulator_(*simulator) {
  simulator_.setInterrupt([this] { return abandoned_.load(std::memory_order_relaxed); });
  thread_ = std::thread([this] { Ending::guard("step", [this] { loop(); }); });
}

StepThread::~StepThread() {
  abandon();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
  simulator_.setInterrupt({});
}

void StepThread::begin(const std::vector<sim::LinkPoses>& poses, double dt) {
  under_way_ = true;
  abandoned_ = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    poses_ = &poses;
    dt_ = dt;
    result_ = nullptr;
    asked_ = true;
  }
  changed_.notify_all();
}

const sim::StepResult* StepThread::wait(Steady::time_point until) {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_until(lock, until, [this] { return result_; }) ? taken() : nullptr;
}

const sim::StepResult* StepThread::wait() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [this] { return result_; });
  return taken();
}

const sim::StepResult* StepThread::taken() {
  under_way_ = false;
  duration_ = took_;
  return result_;
}

void StepThread::loop() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return asked_ || stopping_; });
    if (stopping_) return;
    asked_ = false;
    const bool keep = keeps_ && took_ > kLong;
    lock.unlock();
    const Steady::time_point start = Steady::now();
    before_.reset();
    if (keep) before_ = simulator_.state();
    const sim::StepResult& result = simulator_.step(*poses_, dt_);
    cut_short_ = abandoned_ && !result.report.ok();
    const double took = inSeconds(Steady::now() - start);
    lock.lock();
    took_ = took;
    result_ = &result;
    changed_.notify_all();
  }
}

}  // namespace palpate::node
