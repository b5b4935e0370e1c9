// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include <exception>
#include <optional>

#include "ending.h"
#include "environment.h"
#include "palpate/base/error.h"
#include "realtime.h"

namespace palpate::node {

int runProgram(int argc, char** argv, const char* name, const std::function<int(bool)>& run) {
  start::letLargeWritesFail();
  Ending::catchSignals();
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  std::optional<ros::NodeHandle> alive;  // so that the last words get out
  bool sends_realtime = false;
  {
    // ROS starts its threads now, that which sends what is published among them.
    const RealtimeScope starting;
    alive.emplace();
    sends_realtime = starting.isRealtime();
  }
  Ending::catchShutdownRequests();
  try {
    return run(sends_realtime);
  } catch (const InputError& error) {
    ROS_FATAL_STREAM(error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
}

}  // namespace palpate::node
