// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "palpate/RunRecord.h"
#include "palpate/sim/simulator.h"
#include "ros/input/joint_state_reader.h"
#include "ros/input/tf_lookup.h"

namespace palpate::node {

/// From `first` to `stamp` [ns]. A difference of two times of ROS throws where it is beyond 68
/// years, and a bag may have any.
inline std::int64_t nanoseconds(const ros::Time& first, const ros::Time& stamp) {
  return static_cast<std::int64_t>(stamp.toNSec()) - static_cast<std::int64_t>(first.toNSec());
}

/// Time of a cycle on the simulation's clock [s]: the double nearest to the exact difference, as a
/// decimal number of seconds in a file would be read (Duration::toSec() is not always).
inline double bagTime(const ros::Time& stamp, const ros::Time& first) {
  return static_cast<double>(nanoseconds(first, stamp)) / 1e9;
}

/// What the instruments did at one stamp.
struct BagCycle {
  ros::Time stamp;
  std::vector<sim::LinkPoses> poses;
  std::vector<Eigen::VectorXd> joints;  ///< Empty vectors for instruments that come by tf.
  double progress = 0.0;                ///< Part of the bag that is read, in [0, 1].
};

/// Walks a bag's input messages and puts them together to cycles: one for each stamp, from the
/// first at which every instrument is known, with the newest of every instrument. The live node's
/// rule for stamps holds: one that is late by less than rates.stale_after does not turn time back.
class BagInputs {
 public:
  /// @throws InputError: no such bag, one that checkBag() refuses, or an instrument of the scene
  /// has no messages in it (the topics there are get listed).
  BagInputs(const std::string& file, const sim::Simulator& simulator);

  /// `message` is told each input message with the stamp to record it at, `cycle` each cycle, in
  /// the order of the bag.
  /// @throws InputError: a message is of another type, or cut off.
  void walk(const std::function<void(const rosbag::MessageInstance&, const ros::Time&)>& message,
            const std::function<void(const BagCycle&)>& cycle);

  /// What the results in the bag are of, as nodes said it.
  /// @throws InputError: such a message is cut off.
  std::vector<palpate::RunRecord> runRecords() const;

  long dropped() const { return dropped_; }
  const std::string& firstProblem() const { return first_problem_; }

 private:
  struct Source {
    std::string topic;                         // joints; empty for tf
    std::unique_ptr<JointStateReader> reader;  // joints
    std::unique_ptr<TfLookup> lookup;          // tf
    bool seen = false;
    ros::Time stamp;
  };

  void readJoints(const rosbag::MessageInstance& message, std::size_t i);
  void readTf(const rosbag::MessageInstance& message);
  void setTransforms(const rosbag::MessageInstance& m, const tf2_msgs::TFMessage& tf);
  void take(std::size_t i, const ros::Time& stamp, const sim::LinkPoses& poses);
  void flush();
  void drop(const std::string& problem);

  std::string file_;
  const sim::Simulator& simulator_;
  rosbag::Bag bag_;
  std::vector<Source> sources_;
  bool uses_tf_ = false;
  tf2::BufferCore buffer_;
  std::function<void(const rosbag::MessageInstance&, const ros::Time&)> on_message_;
  std::function<void(const BagCycle&)> on_cycle_;
  BagCycle cycle_;
  bool pending_ = false;    // cycle_ waits for more of the same stamp
  std::int64_t reordered_;  // [ns]
  long dropped_ = 0;
  std::string first_problem_;
};

}  // namespace palpate::node
