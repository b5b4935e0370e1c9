// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include <exception>
#include <optional>

#include "crash.h"
#include "ending.h"
#include "environment.h"
#include "palpate/base/error.h"
#include "realtime.h"
#include "slave_api.h"

namespace palpate::node {
namespace {

// [s] to leave the ROS graph, whose master may not answer.
constexpr double kToLeave = 1.0;

}  // namespace

int runProgram(int argc, char** argv, const char* name, const std::function<int(bool)>& run) {
  start::letLargeWritesFail();
  Ending::catchSignals();
  Ending::watch();
  Crash::catchAll();
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
  // Who answers the ROS graph's questions takes what anybody sends it: endless nesting is an
  // endless recursion, and less than that may take long.
  runInSlaveThread([&] {
    if (sends_realtime) becomeRealtimeInTurns();
    Crash::catchHere();
  });
  if (!keepQuestionsLocal()) {
    ROS_WARN("other machines can ask this node, though it is known on this one only");
  }
  int status = 1;
  try {
    status = run(sends_realtime);
  } catch (const InputError& error) {
    ROS_FATAL_STREAM(error.what());
    status = kBadInput;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
  }
  if (Crash::signal() != 0) Crash::end();
  Ending::limit(kToLeave, status);
  return status;
}

}  // namespace palpate::node
