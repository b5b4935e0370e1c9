// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "palpate/scene/scene.h"

namespace palpate::node {

/// Publishes what a scene's instruments are moved by: their joint topics, and tf.
class InputPublishers {
 public:
  InputPublishers(ros::NodeHandle handle, const scene::Scene& scene);

  /// `topic` is that of an instrument, see jointTopic().
  void joints(const std::string& topic, const sensor_msgs::JointState& message) const;
  void tf(const tf2_msgs::TFMessage& message) const;
  /// Latched with all that were published before.
  void staticTf(const tf2_msgs::TFMessage& message);

  /// Topics among these to which nobody listens.
  std::vector<std::string> unheard() const;

 private:
  std::map<std::string, ros::Publisher> joints_;  // by topic, which several instruments may share
  ros::Publisher tf_, static_tf_;                 // none where no instrument comes by tf
  tf2_msgs::TFMessage static_frames_;
};

/// Times on the clock of who plays a motion.
struct PlayedTime {
  ros::Time begin;    ///< When the motion began to be played.
  double rate = 1.0;  ///< Seconds of the motion in a second.

  /// When `t` [s] of the motion is played. Absurd times end at the first and last of the clock.
  ros::Time at(double t) const;
};

/// A motion of a scene's instruments, in pieces that are due one after the other.
class Motion {
 public:
  virtual ~Motion() = default;

  /// The next piece is the first one.
  virtual void rewind() = 0;
  /// When the next piece is due [s] from the beginning; none: the motion is over.
  virtual std::optional<double> next() = 0;
  /// Publishes the next piece. The motion has come to `t` [s]: pieces of before of which only the
  /// newest counts may be left out.
  virtual void send(double t, const PlayedTime& played) = 0;
};

}  // namespace palpate::node
