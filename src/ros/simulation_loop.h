// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "live_cycle.h"

namespace palpate::node {

/// The simulation thread: runs the live cycle at most `rate` times a second by the steady clock.
/// A cycle that takes too long costs the ticks it covers; they are never made up for. Where inputs
/// come about as often, cycles come to begin with them (Pace).
class SimulationLoop {
 public:
  SimulationLoop(LiveCycle* cycle, double rate, Arrivals* arrivals);
  ~SimulationLoop();

  void start();
  /// Ends after the running cycle, whose step is abandoned.
  void stop();

  /// Has `task` run in the simulation thread between two cycles, and waits for it at most
  /// `patience` [s]. False: it did not get its turn in that time, and will not.
  bool runBetweenCycles(const std::function<void()>& task, double patience);

 private:
  struct Task;

  void loop();
  void runTasks();

  LiveCycle& cycle_;
  Arrivals& arrivals_;
  Steady::duration period_;
  std::atomic<bool> stopping_{false};
  std::mutex tasks_mutex_;
  std::vector<std::shared_ptr<Task>> tasks_;
  std::thread thread_;
};

}  // namespace palpate::node
