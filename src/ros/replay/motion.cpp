// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion.h"

#include <algorithm>

#include "ros/messages/topics.h"

namespace palpate::node {
namespace {

constexpr std::uint32_t kQueue = 100;  // a slow listener loses none of a bag's messages

}  // namespace

InputPublishers::InputPublishers(ros::NodeHandle handle, const scene::Scene& scene) {
  for (const scene::InstrumentConfig& instrument : scene.instruments) {
    if (instrument.input != "tf") {
      const std::string topic = jointTopic(instrument);
      ros::Publisher& publisher = joints_[absoluteTopic(topic)];
      if (!publisher) publisher = handle.advertise<sensor_msgs::JointState>(topic, kQueue);
    } else if (!tf_) {
      tf_ = handle.advertise<tf2_msgs::TFMessage>("/tf", kQueue);
      static_tf_ = handle.advertise<tf2_msgs::TFMessage>("/tf_static", kQueue, true);
    }
  }
}

void InputPublishers::joints(const std::string& topic,
                             const sensor_msgs::JointState& message) const {
  joints_.at(absoluteTopic(topic)).publish(message);
}

void InputPublishers::tf(const tf2_msgs::TFMessage& message) const { tf_.publish(message); }

void InputPublishers::staticTf(const tf2_msgs::TFMessage& message) {
  for (const geometry_msgs::TransformStamped& transform : message.transforms) {
    auto& all = static_frames_.transforms;
    const auto same = std::find_if(all.begin(), all.end(), [&](const auto& known) {
      return known.child_frame_id == transform.child_frame_id;
    });
    if (same == all.end()) {
      all.push_back(transform);
    } else {
      *same = transform;
    }
  }
  static_tf_.publish(static_frames_);
}

std::vector<std::string> InputPublishers::unheard() const {
  std::vector<std::string> topics;
  const auto look = [&](const ros::Publisher& publisher) {
    if (publisher && publisher.getNumSubscribers() == 0) topics.push_back(publisher.getTopic());
  };
  for (const auto& [topic, publisher] : joints_) look(publisher);
  look(tf_);
  return topics;
}

ros::Time PlayedTime::at(double t) const {
  const double since_zero = static_cast<double>(begin.sec) + t / rate;
  const double highest = static_cast<double>(ros::TIME_MAX.sec) - 1.0;
  if (!(since_zero < highest)) return ros::TIME_MAX;
  if (since_zero < 1.0) return ros::TIME_MIN;
  return begin + ros::Duration(t / rate);
}

}  // namespace palpate::node
