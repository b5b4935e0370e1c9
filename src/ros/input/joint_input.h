// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/JointState.h>

#include <atomic>
#include <mutex>
#include <string>

#include "input.h"
#include "joint_state_reader.h"
#include "one_publisher.h"
#include "palpate/base/latest_value.h"
#include "ros/messages/channels.h"

namespace palpate::node {

/// Joint positions from a JointState topic, of one publisher. A message that does not fit is
/// dropped with a throttled warning and counts as no input.
class JointInput : public Input {
 public:
  /// Subscribes in `handle`'s callback queue, which one thread must serve. `simulator` outlives
  /// this; its forward kinematics is used.
  /// Where the hand and the links are goes to `channels` at once.
  JointInput(ros::NodeHandle handle, const std::string& topic, const std::string& name,
             const sim::Simulator& simulator, int index, Channels* channels);

  bool poll(InputSample* sample) override;
  void forget() override;
  std::string source() const override;
  std::string problem() const override;
  std::string conflict() const override;

 private:
  struct Joints {
    Eigen::VectorXd q;
    ros::Time stamp;
    Steady::time_point received;
  };

  std::string read(const sensor_msgs::JointState& message);
  void receive(const ros::MessageEvent<const sensor_msgs::JointState>& event);

  std::string name_;
  const sim::Simulator& simulator_;
  int index_;
  JointStateReader reader_;
  LatestValue<HandPose>& hand_;
  LatestValue<ToolLinks>& links_;
  Arrivals& arrivals_;
  Joints scratch_;  // the callback's, as the next
  ToolLinks where_;
  LatestValue<Joints> latest_;
  Throttle warning_{5.0};
  mutable std::mutex problem_mutex_;  // of these two
  std::string problem_ = "no message yet";
  OnePublisher publisher_;
  ros::Subscriber subscriber_;  // last: its callback uses the rest
};

}  // namespace palpate::node
