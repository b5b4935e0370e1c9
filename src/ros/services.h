// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <string>
#include <vector>

#include "simulation_loop.h"

namespace palpate::node {

/// ~reset and ~save_state. Served from `handle`'s callback queue, which must be another than that
/// of the inputs: a request waits for its turn in the simulation thread.
class Services {
 public:
  /// `state_directory`: where ~save_state writes; made when needed.
  Services(ros::NodeHandle handle, LiveCycle* cycle, SimulationLoop* loop,
           const std::string& state_directory);

 private:
  using Trigger = std_srvs::Trigger;

  bool reset(Trigger::Request& request, Trigger::Response& response);
  bool saveState(Trigger::Request& request, Trigger::Response& response);

  LiveCycle& cycle_;
  SimulationLoop& loop_;
  std::string state_directory_;
  ros::ServiceServer reset_, save_state_;
};

}  // namespace palpate::node
