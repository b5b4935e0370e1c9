// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_state.h"

namespace palpate::node {

const char* toString(NodeState state) {
  switch (state) {
    case NodeState::kWaiting:
      return "WAITING";
    case NodeState::kRunning:
      return "RUNNING";
    case NodeState::kPaused:
      return "PAUSED";
    case NodeState::kFault:
      return "FAULT";
  }
  return "";
}

const char* toString(ToolState state) {
  switch (state) {
    case ToolState::kWaiting:
      return "WAITING";
    case ToolState::kLive:
      return "LIVE";
    case ToolState::kOutside:
      return "OUTSIDE";
    case ToolState::kStale:
      return "STALE";
  }
  return "";
}

NodeState StateMachine::update(const CycleFacts& facts, double now) {
  if (facts.stepped || facts.late) {
    const bool fails = facts.late || !facts.solved;
    if (fails && !failing_) failing_since_ = now;
    failing_ = fails;
  }
  if (!facts.any_seen) {
    failing_ = false;
    state_ = NodeState::kWaiting;
  } else if (!facts.any_live) {
    failing_ = false;
    state_ = NodeState::kPaused;
  } else {
    state_ =
        failing_ && now - failing_since_ >= kFaultAfter ? NodeState::kFault : NodeState::kRunning;
  }
  return state_;
}

}  // namespace palpate::node
