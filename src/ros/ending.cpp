// SPDX-License-Identifier: GPL-3.0-or-later
#include "ending.h"

#include <poll.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/xmlrpc_manager.h>
#include <semaphore.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <ctime>
#include <exception>
#include <thread>

namespace palpate::node {
namespace {

// What a signal handler may touch.
sem_t asked_once;
std::atomic<bool> is_asked{false};
std::atomic<int> exit_status{0};

static_assert(std::atomic<bool>::is_always_lock_free, "signal handlers must not wait");

struct Semaphore {
  Semaphore() { sem_init(&asked_once, 0, 0); }
} const made;

void note() {
  is_asked = true;
  sem_post(&asked_once);
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

void Ending::catchSignals() {
  struct sigaction action {};
  action.sa_handler = [](int) { note(); };
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

void Ending::catchShutdownRequests() {
  ros::XMLRPCManager::instance()->unbind("shutdown");
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

void Ending::limit(double seconds, int status) {
  std::thread([seconds, status] {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    // Nothing that may hang as well.
    constexpr char kSaid[] = "ending: something hangs, what is left is left\n";
    pollfd out{STDERR_FILENO, POLLOUT, 0};
    if (::poll(&out, 1, 0) == 1 && ::write(STDERR_FILENO, kSaid, sizeof(kSaid) - 1) < 0) {
      // Then nobody hears it.
    }
    ::_exit(status);
  }).detach();
}

void Ending::guard(const char* thread, const std::function<void()>& body) {
  try {
    body();
  } catch (const std::exception& error) {
    fail(std::string("the ") + thread + " thread failed: " + error.what());
  } catch (...) {
    fail(std::string("the ") + thread + " thread failed");
  }
}

}  // namespace palpate::node
