// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <XmlRpcValue.h>

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

/// Runs something in the thread that answers such questions, and waits for it. False: that thread
/// cannot be asked.
bool runInSlaveThread(const std::function<void()>& task);

/// Where this node is known by a name of this machine only, such as localhost (ROS_HOSTNAME,
/// ROS_IP): lets nobody else ask it such questions. ROS keeps topics and services to the machine
/// then, but not these. False: the system does not let us.
bool keepQuestionsLocal();

}  // namespace palpate::node
