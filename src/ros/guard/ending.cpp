// SPDX-License-Identifier: GPL-3.0-or-later
#include "ending.h"

#include <poll.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/xmlrpc_manager.h>
#include <semaphore.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <exception>
#include <limits>
#include <thread>

#include "crash.h"

namespace palpate::node {
namespace {

constexpr std::int64_t kSecond = 1000000000;
constexpr double kToStart = 1.0;    // [s] that ROS has after a signal
constexpr int kSignalStatus = 128;  // and the signal's number

// What a signal handler may touch.
sem_t asked_once, limited;
std::atomic<bool> is_asked{false}, is_started{false};
std::atomic<int> exit_status{0};
std::atomic<std::int64_t> latest_end{std::numeric_limits<std::int64_t>::max()};  // [ns]
std::atomic<int> hanging_status{1};

static_assert(std::atomic<bool>::is_always_lock_free &&
                  std::atomic<std::int64_t>::is_always_lock_free,
              "signal handlers must not wait");

struct Semaphores {
  Semaphores() {
    sem_init(&asked_once, 0, 0);
    sem_init(&limited, 0, 0);
  }
} const made;

// By the steady clock.
std::int64_t nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return kSecond * now.tv_sec + now.tv_nsec;
}

// The end of a program in which something hangs: nothing here may hang as well.
[[noreturn]] void leave() {
  constexpr char kSaid[] = "ending: something hangs, what is left is left\n";
  pollfd out{STDERR_FILENO, POLLOUT, 0};
  if (::poll(&out, 1, 0) == 1 && ::write(STDERR_FILENO, kSaid, sizeof(kSaid) - 1) < 0) {
    // Then nobody hears it.
  }
  if (Crash::signal() != 0) Crash::end();
  ::_exit(hanging_status);
}

void shutdownRequested(XmlRpc::XmlRpcValue& parameters, XmlRpc::XmlRpcValue& result) {
  std::string why = "shutdown requested";
  if (parameters.getType() == XmlRpc::XmlRpcValue::TypeArray && parameters.size() > 1 &&
      parameters[1].getType() == XmlRpc::XmlRpcValue::TypeString) {
    why += ": " + static_cast<std::string>(parameters[1]);
  }
  result = ros::xmlrpc::responseInt(1, "", 0);
  Ending::ask(why);
}

}  // namespace

void Ending::note() {
  is_asked = true;
  sem_post(&asked_once);
}

void Ending::catchSignals() {
  struct sigaction action {};
  action.sa_handler = [](int signal) {
    note();
    if (!is_started) limit(kToStart, kSignalStatus + signal);
  };
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

void Ending::started() { is_started = true; }

void Ending::catchShutdownRequests() {
  ros::XMLRPCManager::instance()->bind("shutdown", shutdownRequested);
}

void Ending::ask(const std::string& why) {
  ROS_INFO_STREAM("ending: " << why);
  note();
}

void Ending::fail(const std::string& what) {
  exit_status = 1;
  ROS_FATAL_STREAM(what);
  note();
}

bool Ending::asked() { return is_asked || !ros::ok(); }

void Ending::wait() {
  while (!asked()) {
    timespec until{};  // now and then ROS is asked, too
    clock_gettime(CLOCK_MONOTONIC, &until);
    ++until.tv_sec;
    sem_clockwait(&asked_once, CLOCK_MONOTONIC, &until);
  }
}

int Ending::status() { return exit_status; }

void Ending::watch() {
  std::thread([] {
    while (nanoseconds() < latest_end) {
      timespec until{};
      until.tv_sec = std::min<long>(latest_end / kSecond, nanoseconds() / kSecond + 3600);
      until.tv_nsec = latest_end % kSecond;
      sem_clockwait(&limited, CLOCK_MONOTONIC, &until);
    }
    leave();
  }).detach();
}

void Ending::limit(double seconds, int status) {
  const std::int64_t end = nanoseconds() + static_cast<std::int64_t>(seconds * 1e9);
  std::int64_t before = latest_end;
  while (end < before && !latest_end.compare_exchange_weak(before, end)) {
  }
  if (end < before) hanging_status = status;
  sem_post(&limited);
}

void Ending::guard(const char* thread, const std::function<void()>& body) {
  Crash::catchHere();
  try {
    body();
  } catch (const std::exception& error) {
    fail(std::string("the ") + thread + " thread failed: " + error.what());
  } catch (...) {
    fail(std::string("the ") + thread + " thread failed");
  }
}

}  // namespace palpate::node
