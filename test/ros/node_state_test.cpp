// SPDX-License-Identifier: GPL-3.0-or-later
#include "ros/messages/node_state.h"

#include <gtest/gtest.h>

namespace palpate::node::node_state_test {
namespace {

CycleFacts facts(bool seen, bool live, bool stepped, bool solved) {
  CycleFacts f;
  f.any_seen = seen;
  f.any_live = live;
  f.stepped = stepped;
  f.solved = solved;
  return f;
}

TEST(NodeState, WaitsRunsPausesAndComesBack) {
  StateMachine machine;
  EXPECT_EQ(machine.state(), NodeState::kWaiting);
  EXPECT_EQ(machine.update(facts(false, false, false, false), 0.0), NodeState::kWaiting);
  EXPECT_EQ(machine.update(facts(false, true, false, false), 0.1), NodeState::kWaiting);
  EXPECT_EQ(machine.update(facts(true, true, true, true), 0.2), NodeState::kRunning);
  EXPECT_EQ(machine.update(facts(true, false, false, false), 0.3), NodeState::kPaused);
  EXPECT_EQ(machine.update(facts(true, true, true, true), 0.4), NodeState::kRunning);
  EXPECT_EQ(machine.update(facts(false, false, false, false), 0.5), NodeState::kWaiting);
}

TEST(NodeState, FaultIsAFailureThatLasts) {
  StateMachine machine;
  const CycleFacts good = facts(true, true, true, true), bad = facts(true, true, true, false);
  EXPECT_EQ(machine.update(bad, 0.0), NodeState::kRunning);
  EXPECT_EQ(machine.update(bad, 0.9 * kFaultAfter), NodeState::kRunning);
  EXPECT_EQ(machine.update(good, 0.95 * kFaultAfter), NodeState::kRunning);
  EXPECT_EQ(machine.update(bad, 1.0 * kFaultAfter), NodeState::kRunning);
  EXPECT_EQ(machine.update(bad, 2.1 * kFaultAfter), NodeState::kFault);
  EXPECT_EQ(machine.update(good, 2.2 * kFaultAfter), NodeState::kRunning);
}

TEST(NodeState, AStepThatDoesNotEndIsAFault) {
  StateMachine machine;
  const CycleFacts good = facts(true, true, true, true);
  CycleFacts late = facts(true, true, false, false);
  late.late = true;
  EXPECT_EQ(machine.update(good, 0.0), NodeState::kRunning);
  EXPECT_EQ(machine.update(late, 0.1), NodeState::kRunning);
  EXPECT_EQ(machine.update(late, 0.2 + kFaultAfter), NodeState::kFault);
  EXPECT_EQ(machine.update(good, 0.3 + kFaultAfter), NodeState::kRunning);
}

TEST(NodeState, APauseEndsAFault) {
  StateMachine machine;
  const CycleFacts bad = facts(true, true, true, false);
  machine.update(bad, 0.0);
  EXPECT_EQ(machine.update(bad, 1.0), NodeState::kFault);
  EXPECT_EQ(machine.update(facts(true, false, false, false), 1.1), NodeState::kPaused);
  EXPECT_EQ(machine.update(bad, 1.2), NodeState::kRunning);
}

}  // namespace
}  // namespace palpate::node::node_state_test
