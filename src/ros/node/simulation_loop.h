// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <future>
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
  /// Ends after the running cycle. Its step is abandoned, at once or where it has not ended by
  /// `until`. Who waits for a turn gets none.
  void stop(Steady::time_point until = Steady::time_point());

  /// Has `task` run in the simulation thread between two cycles, and waits for it at most
  /// `patience` [s]. False: it did not get its turn, and will not.
  bool runBetweenCycles(const std::function<void()>& task, double patience);

 private:
  struct Task;

  void loop();
  void runTasks();
  void close();

  LiveCycle& cycle_;
  Arrivals& arrivals_;
  Steady::duration period_;
  std::atomic<bool> stopping_{false};
  std::mutex tasks_mutex_;  // of the next two
  std::vector<std::shared_ptr<Task>> tasks_;
  bool closed_ = false;  // nobody runs tasks any more
  std::promise<void> ended_;
  std::thread thread_;
};

}  // namespace palpate::node
