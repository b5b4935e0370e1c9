// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

namespace palpate::node {

/// Why a program of the node ends: a signal, `rosnode kill`, an exception in one of its threads, or
/// the crash of one (Crash).
/// They only ask; what must still be done, such as taking a force back, the program does before it
/// shuts ROS down. One a process: signals know no objects.
class Ending {
 public:
  /// SIGINT, SIGTERM and SIGHUP ask. Each has its own way again once it came: a second Ctrl-C ends
  /// the program at once. Call before ros::init(), with ros::init_options::NoSigintHandler.
  /// Until started() such a signal limits the program to a second: ROS waits for its master and
  /// asks nobody. The exit status is then 128 and the signal's number, as of a shell.
  static void catchSignals();
  /// ROS is there. Call after the first NodeHandle.
  static void started();
  /// Starts the thread that limit() needs. Before a crash: nothing can be started after one.
  static void watch();
  /// The shutdown that `rosnode kill` and a second node of this name request asks as well. Call
  /// before ROS starts, whose own answer it is instead of.
  static void catchShutdownRequests();

  /// Safe in any thread and in a signal's handler; says nothing.
  static void note();
  /// Safe in any thread.
  static void ask(const std::string& why);
  /// The program ends with status 1, and says so.
  static void fail(const std::string& what);
  static bool asked();
  /// Until somebody asks.
  static void wait();
  /// 0, or 1 after fail().
  static int status();
  /// From now on the program ends within `seconds`, with `status` if something still hangs then: a
  /// disk, a master that does not answer, who reads what it says. What is left undone is left. Of
  /// several limits the first counts. Safe in a signal's handler.
  static void limit(double seconds, int status);

  /// Runs the body of a thread; an exception in it is a fail() that names the thread, and one that
  /// has used up its stack is a Crash as others are.
  static void guard(const char* thread, const std::function<void()>& body);
};

}  // namespace palpate::node
