// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulation_loop.h"

#include <future>
#include <memory>

#include "ending.h"
#include "pace.h"

namespace palpate::node {

struct SimulationLoop::Task {
  std::function<void()> run;
  std::atomic<bool> taken{false};  // by the simulation thread, or by the one who gave up
  std::promise<void> done;
};

SimulationLoop::SimulationLoop(LiveCycle* cycle, double rate, Arrivals* arrivals)
    : cycle_(*cycle), arrivals_(*arrivals), period_(seconds(1.0 / rate)) {}

SimulationLoop::~SimulationLoop() { stop(); }

void SimulationLoop::start() {
  thread_ = std::thread([this] { Ending::guard("simulation", [this] { loop(); }); });
}

void SimulationLoop::stop() {
  stopping_ = true;
  cycle_.abandonStep();
  if (thread_.joinable()) thread_.join();
}

void SimulationLoop::loop() {
  Pace pace(period_, Steady::now());
  while (!stopping_) {
    runTasks();
    arrivals_.clear();
    cycle_.run();
    pace.ended(Steady::now());
    const Pace::Plan plan = pace.next(arrivals_.last(), arrivals_.interval());
    std::this_thread::sleep_until(plan.from);
    if (!arrivals_.pending()) arrivals_.wait(plan.until);
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
    task->run();
    task->done.set_value();
  }
}

bool SimulationLoop::runBetweenCycles(const std::function<void()>& task, double patience) {
  auto posted = std::make_shared<Task>();
  posted->run = task;
  std::future<void> done = posted->done.get_future();
  {
    std::lock_guard<std::mutex> lock(tasks_mutex_);
    tasks_.push_back(posted);
  }
  if (done.wait_for(seconds(patience)) == std::future_status::ready) return true;
  if (!posted->taken.exchange(true)) return false;
  done.wait();  // it is running right now
  return true;
}

}  // namespace palpate::node
