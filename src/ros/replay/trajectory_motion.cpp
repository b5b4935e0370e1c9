// SPDX-License-Identifier: GPL-3.0-or-later
#include "trajectory_motion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "palpate/io/joint_columns.h"
#include "palpate/scene/scene_parts.h"
#include "ros/messages/conversions.h"
#include "ros/messages/topics.h"

namespace palpate::node {
namespace {

void addLinks(const instrument::Instrument& instrument, const scene::InstrumentConfig& config,
              const Eigen::VectorXd& q, const ros::Time& stamp, tf2_msgs::TFMessage* message) {
  std::vector<Pose> links;
  instrument.linkPoses(q, &links);
  const Pose X_WB = config.base.pose();
  for (std::size_t l = 0; l < links.size(); ++l) {
    message->transforms.push_back(
        toMsg(X_WB * links[l], kWorldFrame, config.tf_prefix + instrument.linkNames()[l], stamp));
  }
}

}  // namespace

TrajectoryMotion::TrajectoryMotion(const std::string& file, const scene::Scene& scene,
                                   double period, InputPublishers* publishers)
    : trajectory_(formats::readTrajectory(file)), period_(period), publishers_(*publishers) {
  std::vector<instrument::Instrument> instruments = scene::readInstruments(scene);
  std::vector<io::InstrumentJoints> joints;
  for (std::size_t i = 0; i < instruments.size(); ++i) {
    joints.push_back({scene.instruments[i].name, instruments[i].jointNames()});
  }
  std::vector<std::vector<int>> columns = io::jointColumns(trajectory_, joints, file);
  for (std::size_t i = 0; i < instruments.size(); ++i) {
    tools_.push_back({std::move(instruments[i]), scene.instruments[i], std::move(columns[i])});
  }
  const double length = trajectory_.t.back() - trajectory_.t.front();
  constexpr double kMost = 1e15;  // of pieces
  ticks_ = static_cast<std::size_t>(std::min(std::ceil(length / period_ - 1e-6), kMost)) + 1;
}

double TrajectoryMotion::timeOf(std::size_t tick) const {
  const double length = trajectory_.t.back() - trajectory_.t.front();
  return tick + 1 == ticks_ ? length : period_ * static_cast<double>(tick);
}

std::optional<double> TrajectoryMotion::next() {
  if (tick_ == ticks_) return std::nullopt;
  return timeOf(tick_);
}

Eigen::VectorXd TrajectoryMotion::valuesAt(double t) const {
  const std::vector<double>& times = trajectory_.t;
  const auto after = std::upper_bound(times.begin(), times.end(), times.front() + t);
  if (after == times.begin()) return trajectory_.values.leftCols(1);
  if (after == times.end()) return trajectory_.values.rightCols(1);
  const Eigen::Index k = after - times.begin();
  const double from = *(after - 1), s = (times.front() + t - from) / (*after - from);
  return (1.0 - s) * trajectory_.values.col(k - 1) + s * trajectory_.values.col(k);
}

Eigen::VectorXd TrajectoryMotion::jointsOf(const Tool& tool, const Eigen::VectorXd& values) const {
  Eigen::VectorXd q(static_cast<Eigen::Index>(tool.columns.size()));
  for (std::size_t j = 0; j < tool.columns.size(); ++j) {
    q[static_cast<Eigen::Index>(j)] = values[tool.columns[j]];
  }
  return q;
}

void TrajectoryMotion::send(double t, const PlayedTime& played) {
  while (tick_ + 1 < ticks_ && timeOf(tick_ + 1) <= t) ++tick_;  // an arm's newest position counts
  const double due = timeOf(tick_++);
  const Eigen::VectorXd values = valuesAt(due);
  std::map<std::string, sensor_msgs::JointState> joints;  // by topic
  tf2_msgs::TFMessage links;
  for (const Tool& tool : tools_) {
    const Eigen::VectorXd q = jointsOf(tool, values);
    if (tool.config.input == "tf") {
      addLinks(tool.instrument, tool.config, q, played.at(due), &links);
      continue;
    }
    sensor_msgs::JointState& message = joints[jointTopic(tool.config)];
    for (const std::string& name : tool.instrument.jointNames()) message.name.push_back(name);
    message.position.insert(message.position.end(), q.data(), q.data() + q.size());
  }
  for (auto& [topic, message] : joints) {
    message.header.stamp = played.at(due);
    publishers_.joints(topic, message);
  }
  if (!links.transforms.empty()) publishers_.tf(links);
}

}  // namespace palpate::node
