// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mesh_governor.h"
#include "palpate/sim/hand_tools.h"
#include "palpate/sim/simulator.h"
#include "ros/input/input.h"
#include "ros/messages/channels.h"
#include "ros/messages/node_state.h"
#include "ros/pictures/surface_copies.h"
#include "ros/program/throttle.h"
#include "step_length.h"
#include "step_thread.h"

namespace palpate::node {

/// One cycle of the live node: newest inputs, state, a step of the time that went by, results to
/// the channels. The simulation thread owns it. It waits for the step until `solver.deadline`, and
/// then in later cycles; the tools stay where that step has them, and the force as the last one
/// told it.
class LiveCycle {
 public:
  /// `inputs`: one an instrument. The references outlive this.
  LiveCycle(sim::Simulator* simulator, Inputs* inputs, Channels* channels);

  void run();

  /// Rest state; the tools come where they are next commanded to a free pose.
  void reset();
  /// That after the last step that came to its end; one under way is waited for. None if it was
  /// abandoned and left nothing to go back to.
  std::optional<sim::SimulatorState> state() { return state(Steady::time_point::max()); }
  /// The same, but a step under way is abandoned where it has not ended by `until`.
  std::optional<sim::SimulatorState> state(Steady::time_point until);
  /// Whether there was a step since the start or a reset.
  bool stepped() const { return solved_any_; }
  /// From now on state() has something to go back to, see StepThread.
  void keepStates() { stepper_.keepStates(); }
  /// Has a step that is under way end soon, for a reset or the end. From any thread.
  void abandonStep() { stepper_.abandon(); }

  long cycles() const { return steps_; }

 private:
  /// Whether steps cover the time that went by; else results do not depend on time.
  bool isRealTime() const { return simulator_.scene().rates.catch_up > 1; }
  void checkClock();
  void pollInputs();
  bool live(std::size_t i, Steady::time_point now) const;
  ToolState toolState(std::size_t i, Steady::time_point now) const;
  void step(Steady::time_point start);
  void beginStep(Steady::time_point start);
  bool endStep(Steady::time_point start);
  void takeResult(const sim::StepResult& result);
  void governMesh();
  void writeHaptic(Steady::time_point now);
  void writeReport(Steady::time_point now);
  void writePicture(Steady::time_point now);
  void writeStatistics(Steady::time_point now);
  void warnWaiting(const Statistics& statistics);
  void warnSlow(const Statistics& statistics);

  sim::Simulator& simulator_;
  Inputs& inputs_;
  Channels& channels_;
  StateMachine machine_;

  std::vector<InputSample> samples_;
  InputSample polled_;
  std::vector<bool> live_;             // whose input was fresh at the start of the cycle
  std::vector<sim::LinkPoses> poses_;  // of the step under way, as the three below
  double dt_ = 0.0;                    // its length [s]
  std::vector<ros::Time> stamps_;      // of its inputs
  ros::Time stamp_;                    // of the newest of them
  std::vector<HapticTarget> targets_;
  sim::HandTools tools_;
  SurfaceCopies surfaces_;
  StepLength length_;
  MeshGovernor governor_;
  StepThread stepper_;
  bool solved_any_ = false;  // since the last reset
  sim::StepResult result_;   // of the last step since then
  CycleFacts facts_;
  ros::Time last_now_;  // to see simulated time go back
  double cycle_ms_ = 0.0;
  bool said_anything_ = false;
  NodeState reported_ = NodeState::kWaiting;

  long ticks_ = 0, steps_ = 0, unsolved_ = 0, resets_ = 0, unwatched_pictures_ = 0;
  tissue::SkipCounters skipped_;
  std::vector<double> cycle_times_;  // of this second [ms]
  std::vector<double> input_ages_;   // likewise
  advice::CostRecorder costs_;       // likewise
  advice::SceneFacts scene_facts_;
  long window_ticks_ = 0;
  double window_time_ = 0.0;  // simulated in this second [s]
  Steady::time_point window_start_ = Steady::now();
  Throttle idle_report_{1.0}, picture_, unwatched_, idle_picture_{1.0};
  Throttle waiting_warning_{5.0}, slow_warning_{5.0}, fault_warning_{5.0}, stamp_warning_{5.0};
};

}  // namespace palpate::node
