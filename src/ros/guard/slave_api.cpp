// SPDX-License-Identifier: GPL-3.0-or-later
#include "slave_api.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <sys/socket.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <utility>

namespace palpate::node {
namespace {

using XmlRpc::XmlRpcValue;

constexpr char kTaskMethod[] = "palpateTask";

// The name of a caller, and what it says.
XmlRpcValue call(const std::string& caller, const std::vector<XmlRpcValue>& arguments) {
  XmlRpcValue array;
  array.setSize(static_cast<int>(arguments.size()) + 1);
  array[0] = caller;
  for (int i = 1; i < array.size(); ++i) array[i] = arguments[static_cast<std::size_t>(i - 1)];
  return array;
}

bool isLoopback(const std::string& host) {
  return host == "localhost" || host == "::1" || host.rfind("127.", 0) == 0;
}

// The listening socket at a port, among the files of this process; -1: there is none.
int listenerAt(std::uint32_t port) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int fd = std::atoi(entry.path().filename().c_str());
    int listens = 0;
    socklen_t size = sizeof(listens);
    if (getsockopt(fd, SOL_SOCKET, SO_ACCEPTCONN, &listens, &size) != 0 || listens == 0) continue;
    sockaddr_storage address{};
    size = sizeof(address);
    if (getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) != 0) continue;
    // The port stands at the same place in the addresses of both families.
    if (address.ss_family != AF_INET && address.ss_family != AF_INET6) continue;
    if (ntohs(reinterpret_cast<sockaddr_in*>(&address)->sin_port) == port) return fd;
  }
  return -1;
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

SlaveThreadTask::SlaveThreadTask(std::function<void()> task) : task_(std::move(task)) {
  ros::XMLRPCManager::instance()->bind(kTaskMethod, [this](XmlRpcValue&, XmlRpcValue& result) {
    if (!ran_.exchange(true)) task_();
    result = ros::xmlrpc::responseInt(1, "", 0);
  });
}

SlaveThreadTask::~SlaveThreadTask() { ros::XMLRPCManager::instance()->unbind(kTaskMethod); }

bool SlaveThreadTask::run() {
  XmlRpcValue answer;
  return askSelf(kTaskMethod, {}, &answer) && ran_;
}

bool keepQuestionsLocal() {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(ros::XMLRPCManager::instance()->getServerURI(), host, port)) {
    return false;
  }
  if (!isLoopback(host)) return true;
  constexpr char kLoopback[] = "lo";
  const int fd = listenerAt(port);
  return fd >= 0 && setsockopt(fd, SOL_SOCKET, SO_BINDTODEVICE, kLoopback, sizeof(kLoopback)) == 0;
}

}  // namespace palpate::node
