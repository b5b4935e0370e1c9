// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_state_reader.h"

namespace palpate::node {

JointStateReader::JointStateReader(const instrument::Instrument& instrument)
    : num_joints_(static_cast<Eigen::Index>(instrument.joints().size())),
      mapper_(instrument.jointNames()) {}

std::string JointStateReader::read(const sensor_msgs::JointState& message, Eigen::VectorXd* q) {
  return mapper_.map(message.name, message.position.data(), message.position.size(), q).problem;
}

}  // namespace palpate::node
