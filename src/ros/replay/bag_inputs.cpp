// SPDX-License-Identifier: GPL-3.0-or-later
#include "bag_inputs.h"

#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bag_messages.h"
#include "palpate/base/error.h"
#include "ros/messages/topics.h"

namespace palpate::node {
namespace {

bool areFinite(const sim::LinkPoses& poses) {
  return std::all_of(poses.begin(), poses.end(),
                     [](const Pose& X) { return X.matrix().allFinite(); });
}

}  // namespace

BagInputs::BagInputs(const std::string& file, const sim::Simulator& simulator)
    : file_(file),
      simulator_(simulator),
      reordered_(std::llround(1e9 * simulator.scene().rates.stale_after)) {
  for (int i = 0; i < simulator.numInstruments(); ++i) {
    const scene::InstrumentConfig& config =
        simulator.scene().instruments[static_cast<std::size_t>(i)];
    Source source;
    if (config.input == "tf") {
      source.lookup = std::make_unique<TfLookup>(simulator.instrument(i), config);
      uses_tf_ = true;
    } else {
      source.topic = absoluteTopic(jointTopic(config));
      source.reader = std::make_unique<JointStateReader>(simulator.instrument(i));
    }
    cycle_.joints.emplace_back(
        Eigen::VectorXd::Zero(source.reader ? source.reader->numJoints() : 0));
    sources_.push_back(std::move(source));
  }
  cycle_.poses.resize(sources_.size());
  openInputBag(file, simulator.scene(), &bag_);
}

void BagInputs::walk(
    const std::function<void(const rosbag::MessageInstance&, const ros::Time&)>& message,
    const std::function<void(const BagCycle&)>& cycle) {
  on_message_ = message;
  on_cycle_ = cycle;
  rosbag::View view(bag_, [this](const rosbag::ConnectionInfo* connection) {
    if (uses_tf_ && (isTf(connection->topic) || isStaticTf(connection->topic))) return true;
    return std::any_of(sources_.begin(), sources_.end(), [&](const Source& source) {
      return source.reader && source.topic == absoluteTopic(connection->topic);
    });
  });
  const double size = std::max(1.0, static_cast<double>(view.size()));
  double count = 0.0;
  try {
    for (const rosbag::MessageInstance& m : view) {
      cycle_.progress = ++count / size;
      if (isTf(m.getTopic()) || isStaticTf(m.getTopic())) readTf(m);
      for (std::size_t i = 0; i < sources_.size(); ++i) {
        if (sources_[i].reader && sources_[i].topic == absoluteTopic(m.getTopic()))
          readJoints(m, i);
      }
    }
  } catch (const rosbag::BagException& e) {
    throw InputError(file_, "", "", "cannot be read to its end: " + bagProblem(e));
  }
  flush();
}

std::vector<palpate::RunRecord> BagInputs::runRecords() const {
  using Traits = ros::message_traits::MD5Sum<palpate::RunRecord>;
  std::vector<palpate::RunRecord> records;
  try {
    rosbag::View view(bag_, [](const rosbag::ConnectionInfo* connection) {
      return connection->md5sum == Traits::value();
    });
    for (const rosbag::MessageInstance& m : view) {
      records.push_back(*decodedMessage<palpate::RunRecord>(m, file_));
    }
  } catch (const rosbag::BagException& e) {
    throw InputError(file_, "", "", "cannot be read to its end: " + bagProblem(e));
  }
  return records;
}

void BagInputs::readJoints(const rosbag::MessageInstance& m, std::size_t i) {
  const auto joints = decodedMessage<sensor_msgs::JointState>(m, file_);
  Eigen::VectorXd q = cycle_.joints[i];
  const std::string problem = sources_[i].reader->read(*joints, &q);
  const ros::Time stamp = joints->header.stamp.isZero() ? m.getTime() : joints->header.stamp;
  on_message_(m, stamp);
  if (!problem.empty()) return drop(m.getTopic() + ": " + problem);
  const ros::Time before = sources_[i].stamp;
  if (sources_[i].seen && stamp < before && nanoseconds(stamp, before) < reordered_) {
    return drop(m.getTopic() + ": older than the message before");
  }
  if (pending_ && stamp != cycle_.stamp) flush();
  cycle_.joints[i] = q;
  take(i, stamp, simulator_.linkPoses(static_cast<int>(i), q));
}

void BagInputs::setTransforms(const rosbag::MessageInstance& m, const tf2_msgs::TFMessage& tf) {
  try {
    for (const geometry_msgs::TransformStamped& transform : tf.transforms) {
      buffer_.setTransform(transform, "bag", isStaticTf(m.getTopic()));
    }
  } catch (const std::runtime_error& e) {  // of times that tf2 cannot add
    throw InputError(file_, m.getTopic(), "",
                     std::string("has a transform out of time: ") + e.what());
  }
}

void BagInputs::readTf(const rosbag::MessageInstance& m) {
  const auto tf = decodedMessage<tf2_msgs::TFMessage>(m, file_);
  ros::Time newest = ros::TIME_MIN;
  for (const geometry_msgs::TransformStamped& transform : tf->transforms) {
    newest = std::max(newest, transform.header.stamp);
  }
  on_message_(m, isStaticTf(m.getTopic()) ? m.getTime() : newest);
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (sources_[i].lookup && sources_[i].seen && !isStaticTf(m.getTopic()) &&
        nanoseconds(newest, sources_[i].stamp) >= reordered_) {
      buffer_.clear();  // time went back: what is in it would hide the new
    }
  }
  setTransforms(m, *tf);
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (!sources_[i].lookup) continue;
    sim::LinkPoses poses;
    ros::Time stamp;
    const std::string problem = sources_[i].lookup->lookup(buffer_, &poses, &stamp);
    if (!problem.empty() && first_problem_.empty() && !sources_[i].seen) first_problem_ = problem;
    if (!problem.empty()) continue;
    if (!areFinite(poses)) {  // tf refuses NaN, and lets infinity pass
      drop(m.getTopic() + ": a transform is not finite");
      continue;
    }
    if (stamp.isZero()) stamp = m.getTime();
    if (sources_[i].seen && stamp == sources_[i].stamp) continue;
    if (pending_ && stamp != cycle_.stamp) flush();
    take(i, stamp, poses);
  }
}

void BagInputs::take(std::size_t i, const ros::Time& stamp, const sim::LinkPoses& poses) {
  sources_[i].seen = true;
  sources_[i].stamp = stamp;
  cycle_.poses[i] = poses;
  // A message of another instrument that is a little late joins the present.
  const bool late = stamp < cycle_.stamp && nanoseconds(stamp, cycle_.stamp) < reordered_;
  if (!late) cycle_.stamp = stamp;
  pending_ = true;
}

void BagInputs::flush() {
  const bool all = std::all_of(sources_.begin(), sources_.end(),
                               [](const Source& source) { return source.seen; });
  if (pending_ && all) on_cycle_(cycle_);
  pending_ = false;
}

void BagInputs::drop(const std::string& problem) {
  ++dropped_;
  if (first_problem_.empty()) first_problem_ = problem;
}

}  // namespace palpate::node
