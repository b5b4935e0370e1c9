// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/poll_manager.h>

#include <chrono>
#include <exception>
#include <future>
#include <iostream>
#include <memory>
#include <mutex>
#include <optional>

#include "environment.h"
#include "palpate/base/error.h"
#include "realtime.h"
#include "ros/guard/crash.h"
#include "ros/guard/ending.h"
#include "ros/guard/master_wait.h"
#include "ros/guard/slave_api.h"

namespace palpate::node {
namespace {

// [s] to leave the ROS graph, whose master may not answer.
constexpr double kToLeave = 1.0;

// Without the thread of ROS that sends no zero comes to the hand: where it crashes, a program that
// stayed would only keep the force there for longer.
void markSendingThread() {
  struct Marked {
    std::once_flag once;
    std::promise<void> done;
  };
  const auto marked = std::make_shared<Marked>();  // the listener's, too, however long it takes
  const auto& manager = ros::PollManager::instance();
  const auto listener = manager->addPollThreadListener([marked] {
    std::call_once(marked->once, [&] {
      Crash::isFatalHere();
      marked->done.set_value();
    });
  });
  marked->done.get_future().wait_for(std::chrono::seconds(1));  // it looks ten times a second
  manager->removePollThreadListener(listener);
}

}  // namespace

int runProgram(int argc, char** argv, const char* name, const About& about,
               const std::function<int(bool)>& run) {
  if (const std::optional<int> status = answerOptions(argc, argv, about)) return *status;
  try {
    waitForMaster(argc, argv, about.program.c_str());
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return kBadInput;
  }
  start::letLargeWritesFail();
  Ending::catchSignals();
  Ending::watch();
  Crash::catchAll();
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  std::optional<ros::NodeHandle> alive;  // so that the last words get out
  bool sends_realtime = false;
  Ending::catchShutdownRequests();
  // Who answers the ROS graph's questions takes what anybody sends it: endless nesting is an
  // endless recursion, and less than that may take long.
  std::optional<SlaveThreadTask> in_slave_thread(std::in_place, [&] {
    if (sends_realtime) becomeRealtimeInTurns();
    Crash::catchHere();
  });
  {
    // ROS starts its threads now, that which sends what is published among them.
    const RealtimeScope starting;
    alive.emplace();
    sends_realtime = starting.isRealtime();
  }
  Ending::started();
  in_slave_thread->run();
  in_slave_thread.reset();
  markSendingThread();
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
