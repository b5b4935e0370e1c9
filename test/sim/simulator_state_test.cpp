// SPDX-License-Identifier: GPL-3.0-or-later
// A whole state as bytes.
#include "palpate/sim/simulator_state.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace palpate::sim::simulator_state_test {
namespace {

TEST(SimulatorState, IsItsBytes) {
  SimulatorState state;
  state.scene = "slab";
  state.time = 1.25;
  state.models.push_back({"fem", {"organ"}, {"fem, 4 points", "bytes"}});
  state.tools = "hands";
  EXPECT_TRUE(SimulatorState::fromBytes(state.bytes()) == state);
}

TEST(SimulatorState, HasATime) {
  for (const double time :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    SimulatorState state;
    state.time = time;
    EXPECT_THROW(SimulatorState::fromBytes(state.bytes()), std::invalid_argument);
  }
}

}  // namespace
}  // namespace palpate::sim::simulator_state_test
