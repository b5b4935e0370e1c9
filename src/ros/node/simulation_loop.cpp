// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation_loop.h"

#include <memory>

#include "pace.h"
#include "ros/guard/ending.h"

namespace palpate::node {

struct SimulationLoop::Task {
  std::function<void()> run;
  std::atomic<bool> taken{false};  // by the simulation thread, or by the one who gave up
  std::promise<bool> done;         // whether it ran
};

SimulationLoop::SimulationLoop(LiveCycle* cycle, double rate, Arrivals* arrivals)
    : cycle_(*cycle), arrivals_(*arrivals), period_(seconds(1.0 / rate)) {}

SimulationLoop::~SimulationLoop() { stop(); }

void SimulationLoop::start() {
  thread_ = std::thread([this] {
    Ending::guard("simulation", [this] { loop(); });
    close();
    ended_.set_value();
  });
}

void SimulationLoop::stop(Steady::time_point until) {
  stopping_ = true;
  if (!thread_.joinable()) return;
  const bool ended = ended_.get_future().wait_until(until) == std::future_status::ready;
  if (!ended) cycle_.abandonStep();
  thread_.join();
}

void SimulationLoop::close() {
  const std::lock_guard<std::mutex> lock(tasks_mutex_);
  closed_ = true;
  for (const auto& task : tasks_) {
    if (!task->taken.exchange(true)) task->done.set_value(false);
  }
  tasks_.clear();
}

void SimulationLoop::loop() {
  Pace pace(period_, Steady::now());
  while (!stopping_) {
    runTasks();
    if (stopping_) break;
    arrivals_.clear();
    cycle_.run();
    pace.ended(Steady::now());
    const Steady::time_point last = arrivals_.last();
    const Pace::Plan plan = pace.next(last, arrivals_.interval());
    std::this_thread::sleep_until(plan.from);
    if (plan.afresh) arrivals_.clear();
    const bool there = arrivals_.pending() || (plan.afresh && arrivals_.last() > last);
    if (!there) arrivals_.wait(plan.until);
    pace.began(Steady::now());
  }
}

void SimulationLoop::runTasks() {
  std::vector<std::shared_ptr<Task>> tasks;
  {
    std::lock_guard<std::mutex> lock(tasks_mutex_);
    tasks.swap(tasks_);
  }
  for (const auto& task : tasks) {
    if (task->taken.exchange(true)) continue;
    try {
      task->run();
    } catch (...) {
      task->done.set_value(false);
      throw;
    }
    task->done.set_value(true);
  }
}

bool SimulationLoop::runBetweenCycles(const std::function<void()>& task, double patience) {
  auto posted = std::make_shared<Task>();
  posted->run = task;
  std::future<bool> done = posted->done.get_future();
  {
    std::lock_guard<std::mutex> lock(tasks_mutex_);
    if (closed_) return false;
    tasks_.push_back(posted);
  }
  if (done.wait_for(seconds(patience)) != std::future_status::ready &&
      !posted->taken.exchange(true)) {
    return false;
  }
  return done.get();  // perhaps it is running right now
}

}  // namespace palpate::node
