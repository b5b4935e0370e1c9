// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include "simulation_loop.h"
#include "state_folder.h"

namespace palpate::node {

/// ~reset and ~save_state. Served from `handle`'s callback queue, which must be another than that
/// of the inputs: a request waits for its turn in the simulation thread.
class Services {
 public:
  /// The references outlive this.
  Services(ros::NodeHandle handle, LiveCycle* cycle, SimulationLoop* loop,
           const StateFolder* states);

 private:
  using Trigger = std_srvs::Trigger;

  bool reset(Trigger::Request& request, Trigger::Response& response);
  bool saveState(Trigger::Request& request, Trigger::Response& response);

  LiveCycle& cycle_;
  SimulationLoop& loop_;
  const StateFolder& states_;
  ros::ServiceServer reset_, save_state_;
};

}  // namespace palpate::node
