// SPDX-License-Identifier: GPL-3.0-or-later
#include "services.h"

#include <chrono>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <memory>

#include "palpate/io/state_file.h"
#include "topics.h"

namespace palpate::node {
namespace {

constexpr double kPatience = 5.0;  ///< [s], for the cycle that runs.
constexpr char kBusy[] = "the simulation did not come to it in 5 s; try again";

/// "state-20240229T123456.789Z.state"; a name that sorts by time.
std::string stateFileName() {
  const auto now = std::chrono::system_clock::now();
  const std::time_t t = std::chrono::system_clock::to_time_t(now);
  const auto ms =
      std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count() % 1000;
  std::tm utc{};
  gmtime_r(&t, &utc);
  char date[32], name[64];
  std::strftime(date, sizeof(date), "%Y%m%dT%H%M%S", &utc);
  std::snprintf(name, sizeof(name), "state-%s.%03dZ.state", date, static_cast<int>(ms));
  return name;
}

}  // namespace

Services::Services(ros::NodeHandle handle, LiveCycle* cycle, SimulationLoop* loop,
                   const std::string& state_directory)
    : cycle_(*cycle), loop_(*loop), state_directory_(state_directory) {
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
  const auto state = std::make_shared<sim::SimulatorState>();
  const bool taken = loop_.runBetweenCycles([this, state] { *state = cycle_.state(); }, kPatience);
  if (!taken) {
    response.success = false;
    response.message = kBusy;
    return true;
  }
  try {
    std::filesystem::create_directories(state_directory_);
    const std::string file = (std::filesystem::path(state_directory_) / stateFileName()).string();
    io::writeState(file, *state);
    response.success = true;
    response.message = file;
  } catch (const std::exception& e) {
    response.success = false;
    response.message = e.what();
  }
  return true;
}

}  // namespace palpate::node
