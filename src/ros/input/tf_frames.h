// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "one_publisher.h"

namespace palpate::node {

/// Of all transforms that are published those that lie between the world and some frames, and of
/// these those that a buffer can take: it keeps what it is given, of any number of frames, and
/// throws at stamps that no clock shows. Each frame has one publisher at a time. For one thread.
class TfFrames {
 public:
  using Transform = geometry_msgs::TransformStamped;

  /// Who sent a transform, and when it came.
  struct Source {
    OnePublisher::Connection connection;
    std::string name;
    Steady::time_point time;
  };

  /// `patience` [s]: so long a silence ends the turn of a publisher of what moves, and so far back
  /// a stamp is that of another clock.
  TfFrames(const std::vector<std::string>& frames, double patience, tf2::BufferCore* buffer);

  /// Returns "", or why a transform of a frame that counts is ignored.
  std::string take(const Transform& transform, bool is_static, const Source& source);
  /// Time went back: what was heard before counts no more, but for what is static.
  void forget();
  /// Which two publish one frame; "" if no two do.
  std::string conflict(Steady::time_point now) const;

 private:
  struct Frame {
    bool is_static = false;
    std::optional<OnePublisher> publisher;  // none before the first transform
    ros::Time newest;
  };
  struct Kept {
    Transform transform;
    boost::weak_ptr<const void> connection;  // which ends, however long its transform is kept
    std::string name;
    Steady::time_point time;
  };

  void want(const std::string& name);
  double wayTo(Frame* frame, const ros::Time& stamp);

  double patience_;
  tf2::BufferCore& buffer_;
  std::map<std::string, Frame> wanted_;
  std::map<std::string, Kept> others_;  // static ones, which come but once
};

}  // namespace palpate::node
