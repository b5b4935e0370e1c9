// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_state_reader.h"

#include <algorithm>

namespace palpate::node {
namespace {

// More, or longer ones, no robot has; looking through them takes time that a cycle has not.
constexpr std::size_t kMostNames = 1000, kLongestName = 1000;

}  // namespace

JointStateReader::JointStateReader(const instrument::Instrument& instrument)
    : num_joints_(static_cast<Eigen::Index>(instrument.joints().size())),
      mapper_(instrument.jointNames()) {}

std::string JointStateReader::read(const sensor_msgs::JointState& message, Eigen::VectorXd* q) {
  const std::size_t names = message.name.size();
  if (names > kMostNames) {
    return std::to_string(names) + " joint names; at most " + std::to_string(kMostNames) +
           " are read";
  }
  const auto too_long = [](const std::string& name) { return name.size() > kLongestName; };
  if (std::any_of(message.name.begin(), message.name.end(), too_long)) {
    return "a joint name of more than " + std::to_string(kLongestName) + " letters";
  }
  return mapper_.map(message.name, message.position.data(), message.position.size(), q).problem;
}

}  // namespace palpate::node
