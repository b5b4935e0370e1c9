// SPDX-License-Identifier: GPL-3.0-or-later
#include "services.h"

#include <exception>
#include <memory>
#include <optional>

#include "ros/messages/topics.h"

namespace palpate::node {
namespace {

constexpr double kPatience = 5.0;  ///< [s], for the cycle that runs.
constexpr char kBusy[] = "the simulation did not come to it in 5 s; try again";

constexpr char kAbandoned[] = "the last step was abandoned, by ~reset or at the end";

}  // namespace

Services::Services(ros::NodeHandle handle, LiveCycle* cycle, SimulationLoop* loop,
                   const StateFolder* states)
    : cycle_(*cycle), loop_(*loop), states_(*states) {
  reset_ = handle.advertiseService(kResetService, &Services::reset, this);
  save_state_ = handle.advertiseService(kSaveStateService, &Services::saveState, this);
}

bool Services::reset(Trigger::Request&, Trigger::Response& response) {
  cycle_.abandonStep();
  response.success = loop_.runBetweenCycles([this] { cycle_.reset(); }, kPatience);
  response.message = response.success ? "back to the rest state at time 0" : kBusy;
  return true;
}

bool Services::saveState(Trigger::Request&, Trigger::Response& response) {
  const auto state = std::make_shared<std::optional<sim::SimulatorState>>();
  const bool taken = loop_.runBetweenCycles([this, state] { *state = cycle_.state(); }, kPatience);
  if (!taken || !*state) {
    response.success = false;
    response.message = taken ? kAbandoned : kBusy;
    return true;
  }
  try {
    response.message = states_.add(**state);
    response.success = true;
  } catch (const std::exception& e) {
    response.success = false;
    response.message = e.what();
  }
  return true;
}

}  // namespace palpate::node
