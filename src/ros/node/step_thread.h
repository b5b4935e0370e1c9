// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "palpate/sim/simulator.h"
#include "ros/program/throttle.h"

namespace palpate::node {

/// Makes a simulator's steps in a thread of its own: who asks for one need not wait until it has
/// ended. What a step comes to does not depend on that; it is solved as a replay's is. While one is
/// under way nobody else may use what steps change.
class StepThread {
 public:
  explicit StepThread(sim::Simulator* simulator);
  /// Abandons a step that is under way.
  ~StepThread();
  StepThread(const StepThread&) = delete;
  StepThread& operator=(const StepThread&) = delete;

  /// Begins a step where none is under way. `poses` stay as they are until it has ended.
  void begin(const std::vector<sim::LinkPoses>& poses, double dt);
  bool underWay() const { return under_way_; }
  /// The result of the step under way if it has ended by `until`, else null: ask again.
  const sim::StepResult* wait(Steady::time_point until);
  /// However long it takes.
  const sim::StepResult* wait();
  /// Has the step under way end soon, if there is one. Then its state is good for a reset only.
  /// From any thread.
  void abandon() { abandoned_ = true; }

  /// Whether the last step that ended was abandoned before it had come to its end.
  bool cutShort() const { return cut_short_; }
  /// What the steps so far left is not asked for any more.
  void forget() {
    cut_short_ = false;
    before_.reset();
  }
  /// From now on the state before a step is kept where the step before it took long, for then a
  /// step may have to be abandoned and nobody shall lose what was before; to keep it takes about
  /// as long as a short step.
  void keepStates() { keeps_ = true; }
  /// That before the last step, if it was kept.
  const std::optional<sim::SimulatorState>& before() const { return before_; }

  /// What the last step that ended took [s].
  double duration() const { return duration_; }

 private:
  void loop();
  const sim::StepResult* taken();

  sim::Simulator& simulator_;
  bool under_way_ = false;  // for who asks; until its result was taken
  bool keeps_ = false;
  // The step's, and after it who's asks.
  std::optional<sim::SimulatorState> before_;
  bool cut_short_ = false;
  std::atomic<bool> abandoned_{false};
  double duration_ = 0.0;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool asked_ = false, stopping_ = false;  // under the mutex, as all below
  const std::vector<sim::LinkPoses>* poses_ = nullptr;
  double dt_ = 0.0, took_ = 0.0;
  const sim::StepResult* result_ = nullptr;
  std::thread thread_;
};

}  // namespace palpate::node
