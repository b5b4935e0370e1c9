// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>
#include <tf2_msgs/TFMessage.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ros/program/callback_thread.h"
#include "tf_frames.h"

namespace palpate::node {

/// Fills a buffer from /tf and /tf_static, in a thread of its own, with what some frames need
/// (TfFrames).
class TfListener {
 public:
  /// `buffer` outlives this.
  TfListener(ros::NodeHandle handle, const std::vector<std::string>& frames, double patience,
             tf2::BufferCore* buffer);

  /// Which two publish one of the frames; "" if no two do.
  std::string conflict() const;
  /// Forgets what moved, where simulated time went back and no message has told so yet.
  void checkClock();

 private:
  using Event = ros::MessageEvent<const tf2_msgs::TFMessage>;

  void receiveMoving(const Event& event) { receive(event, false); }
  void receiveStatic(const Event& event) { receive(event, true); }
  void receive(const Event& event, bool is_static);
  void forgetWhenTimeGoesBack();  // under the mutex

  mutable std::mutex mutex_;  // of the frames
  TfFrames frames_;
  ros::Time last_now_;  // to see simulated time go back
  Throttle warning_{5.0};
  ros::CallbackQueue queue_;
  ros::Subscriber moving_, static_;
  CallbackThread thread_;  // last: it uses the rest
};

}  // namespace palpate::node
