// SPDX-License-Identifier: GPL-3.0-or-later
#include "master_wait.h"

#include <XmlRpc.h>
#include <ros/init.h>
#include <ros/network.h>

#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <string>
#include <thread>

#include "palpate/base/error.h"

namespace palpate::node {
namespace {

// Before the program says that it waits, and between two attempts.
constexpr std::chrono::milliseconds kBeforeSaying(500), kBetweenAttempts(100);

constexpr char kRemapping[] = "__master:=";

struct Uri {
  std::string place, key, text;
};

// As ros::init() finds it.
Uri masterUri(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.rfind(kRemapping, 0) == 0) {
      return {"command line", "__master", argument.substr(sizeof(kRemapping) - 1)};
    }
  }
  const char* uri = std::getenv("ROS_MASTER_URI");
  return {"environment", "ROS_MASTER_URI", uri != nullptr ? uri : ros::getDefaultMasterURI()};
}

bool answers(const std::string& host, std::uint32_t port, const char* program) {
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue arguments, answer;
  arguments[0] = std::string("/") + program;
  return client.execute("getPid", arguments, answer);
}

}  // namespace

void waitForMaster(int argc, char** argv, const char* program) {
  const Uri uri = masterUri(argc, argv);
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri.text, host, port)) {
    throw InputError(uri.place, uri.key, uri.text, "must be like http://localhost:11311");
  }
  std::signal(SIGPIPE, SIG_IGN);  // ROS does so as well: a master may hang up
  bool waited = false;
  while (true) {
    std::future<bool> asked =
        std::async(std::launch::async, [&] { return answers(host, port, program); });
    const bool soon = asked.wait_for(kBeforeSaying) == std::future_status::ready;
    if (soon && asked.get()) break;
    if (!waited) {
      std::fprintf(stderr, "%s: waiting for the master at %s\n", program, uri.text.c_str());
    }
    waited = true;
    if (!soon && asked.get()) break;
    std::this_thread::sleep_for(kBetweenAttempts);
  }
  if (waited) std::fprintf(stderr, "%s: the master is there\n", program);
}

}  // namespace palpate::node
