// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_input.h"

#include <ros/console.h>

namespace palpate::node {

JointInput::JointInput(ros::NodeHandle handle, const std::string& topic, const std::string& name,
                       const sim::Simulator& simulator, int index, Channels* channels)
    : name_(name),
      simulator_(simulator),
      index_(index),
      reader_(simulator.instrument(index)),
      hand_(channels->hands[static_cast<std::size_t>(index)]),
      links_(channels->links[static_cast<std::size_t>(index)]),
      arrivals_(channels->arrivals),
      latest_(Joints{Eigen::VectorXd::Zero(reader_.numJoints()), ros::Time(), Steady::now()}),
      publisher_(simulator.scene().rates.stale_after) {
  scratch_.q = Eigen::VectorXd::Zero(reader_.numJoints());
  subscriber_ =
      handle.subscribe(topic, 1, &JointInput::receive, this, ros::TransportHints().tcpNoDelay());
}

void JointInput::receive(const ros::MessageEvent<const sensor_msgs::JointState>& event) {
  const sensor_msgs::JointState::ConstPtr& message = event.getConstMessage();
  std::string problem;
  {
    std::lock_guard<std::mutex> lock(problem_mutex_);
    const OnePublisher::Connection connection = event.getConnectionHeaderPtr();
    if (!publisher_.takes(connection, event.getPublisherName(), Steady::now())) return;
    problem = problem_ = read(*message);
  }
  if (!problem.empty()) {
    if (warning_.due()) ROS_WARN_STREAM(name_ << ": JointState dropped: " << problem);
    return;
  }
  scratch_.stamp = message->header.stamp.isZero() ? ros::Time::now() : message->header.stamp;
  scratch_.received = Steady::now();
  latest_.write(scratch_);
  where_.stamp = scratch_.stamp;
  links_.write(where_);
  const Pose& X_WC = where_.poses[static_cast<std::size_t>(simulator_.controlLink(index_))];
  hand_.write({true, scratch_.stamp, X_WC.translation(), X_WC.linear()});
  arrivals_.tell();
}

std::string JointInput::read(const sensor_msgs::JointState& message) {
  const std::string problem = reader_.read(message, &scratch_.q);
  if (!problem.empty()) return problem;
  where_.poses = simulator_.linkPoses(index_, scratch_.q);
  return sim::inReach(where_.poses) ? "" : kOutOfReach;
}

bool JointInput::poll(InputSample* sample) {
  if (!latest_.hasNew()) return false;
  const Joints& joints = latest_.read();
  sample->valid = true;
  sample->stamp = joints.stamp;
  sample->received = joints.received;
  sample->poses = simulator_.linkPoses(index_, joints.q);
  return true;
}

void JointInput::forget() { latest_.read(); }

std::string JointInput::source() const { return "topic " + subscriber_.getTopic(); }

std::string JointInput::problem() const {
  std::lock_guard<std::mutex> lock(problem_mutex_);
  return problem_;
}

std::string JointInput::conflict() const {
  std::lock_guard<std::mutex> lock(problem_mutex_);
  return publisher_.conflict(Steady::now());
}

}  // namespace palpate::node
