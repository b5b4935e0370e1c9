// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <XmlRpcValue.h>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

namespace palpate::node {

// What nodes and the master ask each other by XML-RPC [ROS master and slave APIs].

/// Asks the master as this node; false: there is none, or it refuses.
bool askMaster(const std::string& method, const std::vector<XmlRpc::XmlRpcValue>& arguments,
               XmlRpc::XmlRpcValue* answer);

/// Calls a function that this node offers to the master and to others.
bool askSelf(const std::string& method, const std::vector<XmlRpc::XmlRpcValue>& arguments,
             XmlRpc::XmlRpcValue* answer);

/// Something to run in the thread that answers such questions. Make it before ROS starts: that
/// thread then holds roscpp's mutex of functions nearly always, and XMLRPCManager::bind() could
/// wait for it without end.
class SlaveThreadTask {
 public:
  explicit SlaveThreadTask(std::function<void()> task);
  ~SlaveThreadTask();
  SlaveThreadTask(const SlaveThreadTask&) = delete;
  SlaveThreadTask& operator=(const SlaveThreadTask&) = delete;
  /// Runs the task there, once, and waits for it. False: that thread cannot be asked.
  bool run();

 private:
  std::function<void()> task_;
  std::atomic<bool> ran_{false};  // anybody may ask while the function is there
};

/// Where this node is known by a name of this machine only, such as localhost (ROS_HOSTNAME,
/// ROS_IP): lets nobody else ask it such questions. ROS keeps topics and services to the machine
/// then, but not these. False: the system does not let us.
bool keepQuestionsLocal();

}  // namespace palpate::node
