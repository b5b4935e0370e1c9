// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sensor_msgs/JointState.h>

#include <Eigen/Core>
#include <string>

#include "palpate/instrument/instrument.h"
#include "palpate/instrument/joint_mapper.h"

namespace palpate::node {

/// JointState to the positions of an instrument's joints, in the instrument's order.
class JointStateReader {
 public:
  explicit JointStateReader(const instrument::Instrument& instrument);

  /// Any order and extra joints are fine. Returns "" and fills `q` [m or rad], or says what is
  /// wrong, naming the joint: one is missing or not finite, names and positions differ in number,
  /// or there are more or longer names than any robot has.
  std::string read(const sensor_msgs::JointState& message, Eigen::VectorXd* q);

  Eigen::Index numJoints() const { return num_joints_; }

 private:
  Eigen::Index num_joints_;
  instrument::JointMapper mapper_;
};

}  // namespace palpate::node
