// SPDX-License-Identifier: GPL-3.0-or-later
#include "slave_api.h"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

#include <atomic>
#include <cstdint>

namespace palpate::node {
namespace {

using XmlRpc::XmlRpcValue;

// The name of a caller, and what it says.
XmlRpcValue call(const std::string& caller, const std::vector<XmlRpcValue>& arguments) {
  XmlRpcValue array;
  array.setSize(static_cast<int>(arguments.size()) + 1);
  array[0] = caller;
  for (int i = 1; i < array.size(); ++i) array[i] = arguments[static_cast<std::size_t>(i - 1)];
  return array;
}

}  // namespace

bool askMaster(const std::string& method, const std::vector<XmlRpcValue>& arguments,
               XmlRpcValue* answer) {
  XmlRpcValue response;
  return ros::master::execute(method, call(ros::this_node::getName(), arguments), response, *answer,
                              false);
}

// By this machine's own address: under the name that others know it by it may be far.
bool askSelf(const std::string& method, const std::vector<XmlRpcValue>& arguments,
             XmlRpcValue* answer) {
  const auto& manager = ros::XMLRPCManager::instance();
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(manager->getServerURI(), host, port)) return false;
  XmlRpc::XmlRpcClient* client = manager->getXMLRPCClient("127.0.0.1", static_cast<int>(port), "/");
  XmlRpcValue response;
  const bool answered = client->execute(method.c_str(), call("/master", arguments), response);
  manager->releaseXMLRPCClient(client);
  return answered && manager->validateXmlrpcResponse(method, response, *answer);
}

bool runInSlaveThread(const std::function<void()>& task) {
  constexpr char kMethod[] = "palpateTask";
  std::atomic<bool> ran{false};  // anybody may ask while the function is there
  const auto run = [&](XmlRpcValue&, XmlRpcValue& result) {
    if (!ran.exchange(true)) task();
    result = ros::xmlrpc::responseInt(1, "", 0);
  };
  const auto& manager = ros::XMLRPCManager::instance();
  XmlRpcValue answer;
  manager->bind(kMethod, run);
  const bool answered = askSelf(kMethod, {}, &answer);
  manager->unbind(kMethod);
  return answered && ran;
}

}  // namespace palpate::node
