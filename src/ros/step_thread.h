// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "palpate/sim/simulator.h"
#include "throttle.h"

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

  /// What the last step that ended took [s].
  double duration() const { return duration_; }

 private:
  void loop();
  const sim::StepResult* taken();

  sim::Simulator& simulator_;
  bool under_way_ = false;  // for who asks; until its result was taken
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
