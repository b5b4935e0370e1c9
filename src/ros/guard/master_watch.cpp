// SPDX-License-Identifier: GPL-3.0-or-later
#include "master_watch.h"

#include <ros/connection_manager.h>
#include <ros/console.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <utility>

#include "ending.h"
#include "slave_api.h"

namespace palpate::node {
namespace {

constexpr std::chrono::milliseconds kPeriod(500);

using XmlRpc::XmlRpcValue;

// Adds to `publishers` those of the topic that this node hears already: the master may not know
// them yet, and whoever is not in the list is hung up on.
void addConnected(const XmlRpcValue& topic, XmlRpcValue* publishers) {
  XmlRpcValue connections;
  if (!askSelf("getBusInfo", {}, &connections)) return;
  for (int i = 0; i < connections.size(); ++i) {
    XmlRpcValue& connection = connections[i];  // [id, who, direction, transport, topic, ...]
    if (!(connection[2] == XmlRpcValue("i")) || !(connection[4] == topic)) continue;
    bool there = false;
    for (int k = 0; k < publishers->size(); ++k) there |= (*publishers)[k] == connection[1];
    if (!there) (*publishers)[publishers->size()] = connection[1];
  }
}

// Adds what stands in a part of the master's table, [[name, [node, ...]], ...], beside this node.
void addOwn(const XmlRpcValue& part, std::set<std::string>* names) {
  const XmlRpcValue self(ros::this_node::getName());
  for (int i = 0; i < part.size(); ++i) {
    const XmlRpcValue& nodes = part[i][1];
    for (int k = 0; k < nodes.size(); ++k) {
      if (nodes[k] == self) names->insert(XmlRpcValue(part[i][0]));
    }
  }
}

}  // namespace

MasterWatch::MasterWatch(std::vector<std::string> services) : services_(std::move(services)) {}

void MasterWatch::start() {
  thread_ = std::thread([this] { Ending::guard("master", [this] { loop(); }); });
}

void MasterWatch::stop() {
  if (!thread_.joinable()) return;
  stopping_.set_value();
  thread_.join();
}

void MasterWatch::loop() {
  XmlRpcValue pid;
  if (askMaster("getPid", {}, &pid)) pid_ = static_cast<int>(pid);
  const std::future<void> stopping = stopping_.get_future();
  while (stopping.wait_for(kPeriod) != std::future_status::ready) look();
}

void MasterWatch::look() {
  XmlRpcValue answer;
  if (!askMaster("getPid", {}, &answer)) {
    if (pid_ != 0) {
      ROS_WARN("the ROS master is gone; who is connected stays so, and the wrench goes on");
    }
    pid_ = 0;
    return;
  }
  const int pid = answer;
  if (pid == pid_ && isKnown()) return;
  registerAgain();
  pid_ = pid;
  ROS_INFO("registered again with the ROS master");
}

bool MasterWatch::isKnown() const {
  std::vector<std::string> advertised, subscribed;
  ros::this_node::getAdvertisedTopics(advertised);
  ros::this_node::getSubscribedTopics(subscribed);
  XmlRpcValue state;  // [publishers, subscribers, services]
  if (!askMaster("getSystemState", {}, &state) || state.size() != 3) return true;
  const auto has = [&state](int part, const std::vector<std::string>& names) {
    std::set<std::string> own;
    addOwn(state[part], &own);
    return std::all_of(names.begin(), names.end(),
                       [&own](const std::string& name) { return own.count(name) != 0; });
  };
  return has(0, advertised) && has(1, subscribed) && has(2, services_);
}

void MasterWatch::registerAgain() const {
  const XmlRpcValue uri(ros::XMLRPCManager::instance()->getServerURI());
  XmlRpcValue topics, answer;
  if (!askSelf("getPublications", {}, &topics)) return;
  for (int i = 0; i < topics.size(); ++i) {
    askMaster("registerPublisher", {topics[i][0], topics[i][1], uri}, &answer);
  }
  XmlRpcValue subscriptions;
  if (!askSelf("getSubscriptions", {}, &subscriptions)) return;
  for (int i = 0; i < subscriptions.size(); ++i) {
    const XmlRpcValue topic = subscriptions[i][0], type = subscriptions[i][1];
    XmlRpcValue publishers;
    if (!askMaster("registerSubscriber", {topic, type, uri}, &publishers)) continue;
    addConnected(topic, &publishers);
    askSelf("publisherUpdate", {topic, publishers}, &answer);
  }
  const std::string service_uri = "rosrpc://" + ros::network::getHost() + ":" +
                                  std::to_string(ros::ConnectionManager::instance()->getTCPPort());
  for (const std::string& service : services_) {
    askMaster("registerService", {XmlRpcValue(service), XmlRpcValue(service_uri), uri}, &answer);
  }
}

}  // namespace palpate::node
