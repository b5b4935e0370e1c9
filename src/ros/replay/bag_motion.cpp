// SPDX-License-Identifier: GPL-3.0-or-later
#include "bag_motion.h"

#include <map>
#include <vector>

#include "bag_inputs.h"
#include "bag_messages.h"
#include "palpate/scene/scene_parts.h"
#include "ros/messages/topics.h"

namespace palpate::node {

BagMotion::BagMotion(const std::string& file, const scene::Scene& scene,
                     InputPublishers* publishers)
    : file_(file), publishers_(*publishers) {
  openInputBag(file, scene, &bag_);
  for (const scene::InstrumentConfig& instrument : scene.instruments) {
    if (instrument.input != "tf") topics_.insert(absoluteTopic(jointTopic(instrument)));
  }
  findFrames(scene);
  rewind();
}

// Links of instruments that come by tf, and what lies between them and the world.
void BagMotion::findFrames(const scene::Scene& scene) {
  std::vector<std::string> left;
  const std::vector<instrument::Instrument> instruments = scene::readInstruments(scene);
  for (std::size_t i = 0; i < instruments.size(); ++i) {
    if (scene.instruments[i].input != "tf") continue;
    for (const std::string& link : instruments[i].linkNames()) {
      left.push_back(frameName(scene.instruments[i].tf_prefix + link));
    }
  }
  if (left.empty()) return;
  std::map<std::string, std::set<std::string>> parents;
  rosbag::View view(bag_, [](const rosbag::ConnectionInfo* connection) {
    return isTf(connection->topic) || isStaticTf(connection->topic);
  });
  for (const rosbag::MessageInstance& m : view) {
    const auto tf = decodedMessage<tf2_msgs::TFMessage>(m, file_);
    for (const geometry_msgs::TransformStamped& transform : tf->transforms) {
      parents[frameName(transform.child_frame_id)].insert(frameName(transform.header.frame_id));
    }
  }
  while (!left.empty()) {
    const std::string frame = left.back();
    left.pop_back();
    if (frame == kWorldFrame || !frames_.insert(frame).second) continue;
    for (const std::string& parent : parents[frame]) left.push_back(parent);
  }
}

bool BagMotion::isInput(const std::string& topic) const {
  if (isTf(topic) || isStaticTf(topic)) return !frames_.empty();
  return topics_.count(absoluteTopic(topic)) > 0;
}

void BagMotion::rewind() {
  view_ = std::make_unique<rosbag::View>(bag_, [this](const rosbag::ConnectionInfo* connection) {
    return isInput(connection->topic);
  });
  message_ = view_->begin();
}

double BagMotion::timeOf(const ros::Time& stamp) const {
  return bagTime(stamp, view_->getBeginTime());
}

std::optional<double> BagMotion::next() {
  if (message_ == view_->end()) return std::nullopt;
  return timeOf(message_->getTime());
}

void BagMotion::sendTf(const rosbag::MessageInstance& message, const PlayedTime& played) {
  const auto recorded = decodedMessage<tf2_msgs::TFMessage>(message, file_);
  tf2_msgs::TFMessage sent;
  for (geometry_msgs::TransformStamped transform : recorded->transforms) {
    if (frames_.count(frameName(transform.child_frame_id)) == 0) continue;
    ros::Time& stamp = transform.header.stamp;
    stamp = played.at(timeOf(stamp.isZero() ? message.getTime() : stamp));
    sent.transforms.push_back(transform);
  }
  if (sent.transforms.empty()) return;
  if (isStaticTf(message.getTopic())) {
    publishers_.staticTf(sent);
  } else {
    publishers_.tf(sent);
  }
}

void BagMotion::send(double, const PlayedTime& played) {
  const rosbag::MessageInstance message = *message_;
  ++message_;
  if (isTf(message.getTopic()) || isStaticTf(message.getTopic())) return sendTf(message, played);
  const auto joints = decodedMessage<sensor_msgs::JointState>(message, file_);
  ros::Time& stamp = joints->header.stamp;
  stamp = played.at(timeOf(stamp.isZero() ? message.getTime() : stamp));
  publishers_.joints(message.getTopic(), *joints);
}

}  // namespace palpate::node
