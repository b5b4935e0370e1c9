// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::node {

/// What the node is doing, as it says in step_report and /diagnostics.
enum class NodeState {
  kWaiting,  ///< No instrument has had an input yet.
  kRunning,
  kPaused,  ///< No instrument has had an input for rates.stale_after; the wrench is gone.
  kFault    ///< The solver has been failing for kFaultAfter; the wrench is gone.
};

inline constexpr double kFaultAfter = 0.5;  ///< [s]

const char* toString(NodeState state);

/// What one instrument is doing. Each for itself: the others go on.
enum class ToolState {
  kWaiting,  ///< It has never had an input.
  kLive,
  kOutside,  ///< It has input, but is commanded into tissue where it never was: lift it out.
  kStale     ///< Its input stopped; it is not there.
};

const char* toString(ToolState state);

/// What one cycle knows.
struct CycleFacts {
  bool any_seen = false;  ///< Some instrument has had an input since the clock went back.
  bool any_live = false;  ///< Some instrument's newest input is fresh enough.
  bool stepped = false;   ///< The simulation made a step in this cycle ...
  bool solved = false;    ///< ... and the tissue took its state.
  bool late = false;      ///< A step is under way that did not end in time.
};

/// Turns the facts of the cycles into a state. No clock: the caller says the time.
class StateMachine {
 public:
  /// `now` [s] on any clock that does not go back.
  NodeState update(const CycleFacts& facts, double now);
  NodeState state() const { return state_; }

 private:
  NodeState state_ = NodeState::kWaiting;
  bool failing_ = false;
  double failing_since_ = 0.0;
};

}  // namespace palpate::node
