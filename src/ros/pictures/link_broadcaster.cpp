// SPDX-License-Identifier: GPL-3.0-or-later
#include "link_broadcaster.h"

#include <tf2_msgs/TFMessage.h>

#include <algorithm>

#include "ros/input/tool_frames.h"
#include "ros/messages/conversions.h"

namespace palpate::node {
namespace {

constexpr double kLinkPeriod = 0.02;   // [s]
constexpr double kRepeatPeriod = 1.0;  // [s]

Eigen::VectorXd restJoints(const instrument::Instrument& instrument) {
  const std::vector<instrument::Joint>& joints = instrument.joints();
  Eigen::VectorXd q(static_cast<Eigen::Index>(joints.size()));
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const instrument::Joint& joint = joints[i];
    q[static_cast<Eigen::Index>(i)] = std::max(joint.lower, std::min(joint.upper, 0.0));
  }
  return q;
}

}  // namespace

LinkBroadcaster::LinkBroadcaster(ros::NodeHandle handle, const sim::Simulator& simulator,
                                 Channels* channels)
    : channels_(*channels),
      publisher_(handle.advertise<tf2_msgs::TFMessage>("/tf", 100)),
      due_(kLinkPeriod) {
  for (int i = 0; i < simulator.numInstruments(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    const scene::InstrumentConfig& config = simulator.scene().instruments[index];
    if (config.input != "joints") continue;
    const instrument::Instrument& instrument = simulator.instrument(i);
    Tool tool;
    tool.index = index;
    tool.X_BW = config.base.pose().inverse();
    tool.root = rootFrame(simulator, i);
    for (const std::string& link : instrument.linkNames()) {
      tool.frames.push_back(config.tf_prefix + link);
    }
    tool.poses = simulator.linkPoses(i, restJoints(instrument));
    tools_.push_back(std::move(tool));
  }
}

/// Whether the tool's poses are to be published, and `sent` is their stamp.
bool LinkBroadcaster::readPoses(Tool* tool, const ros::Time& now) {
  LatestValue<ToolLinks>& links = channels_.links[tool->index];
  const bool fresh = links.hasNew();
  if (!fresh && Steady::now() - tool->sent_at < seconds(kRepeatPeriod)) return false;
  ros::Time stamp = now;
  if (fresh) {
    const ToolLinks& news = links.read();
    tool->poses = news.poses;
    if (news.stamp > tool->sent) stamp = news.stamp;
  }
  if (stamp <= tool->sent) return false;  // tf takes one pose a stamp
  tool->sent = stamp;
  tool->sent_at = Steady::now();
  return true;
}

void LinkBroadcaster::update() {
  if (tools_.empty() || !due_.due() || publisher_.getNumSubscribers() == 0) return;
  const ros::Time now = ros::Time::now();
  if (ros::Time::isSimTime() && now < last_now_) {
    for (Tool& tool : tools_) tool.sent = ros::Time();
  }
  last_now_ = now;
  tf2_msgs::TFMessage message;
  for (Tool& tool : tools_) {
    if (!readPoses(&tool, now)) continue;
    for (std::size_t i = 1; i < tool.frames.size(); ++i) {
      message.transforms.push_back(
          toMsg(tool.X_BW * tool.poses[i], tool.root, tool.frames[i], tool.sent));
    }
  }
  if (!message.transforms.empty()) publisher_.publish(message);
}

}  // namespace palpate::node
