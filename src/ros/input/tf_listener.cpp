// SPDX-License-Identifier: GPL-3.0-or-later
#include "tf_listener.h"

#include <ros/console.h>

namespace palpate::node {

TfListener::TfListener(ros::NodeHandle handle, const std::vector<std::string>& frames,
                       double patience, tf2::BufferCore* buffer)
    : frames_(frames, patience, buffer), thread_("tf", &queue_, false) {
  handle.setCallbackQueue(&queue_);
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  moving_ = handle.subscribe("/tf", 100, &TfListener::receiveMoving, this, hints);
  static_ = handle.subscribe("/tf_static", 100, &TfListener::receiveStatic, this, hints);
  thread_.start();
}

std::string TfListener::conflict() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return frames_.conflict(Steady::now());
}

void TfListener::checkClock() {
  const std::lock_guard<std::mutex> lock(mutex_);
  forgetWhenTimeGoesBack();
}

void TfListener::forgetWhenTimeGoesBack() {
  const ros::Time now = ros::Time::now();
  if (ros::Time::isSimTime() && now < last_now_) frames_.forget();
  last_now_ = now;
}

void TfListener::receive(const Event& event, bool is_static) {
  const std::lock_guard<std::mutex> lock(mutex_);
  forgetWhenTimeGoesBack();
  const TfFrames::Source source{event.getConnectionHeaderPtr(), event.getPublisherName(),
                                Steady::now()};
  std::string problem;
  for (const geometry_msgs::TransformStamped& transform : event.getConstMessage()->transforms) {
    const std::string ignored = frames_.take(transform, is_static, source);
    if (!ignored.empty()) problem = ignored;
  }
  if (!problem.empty() && warning_.due()) {
    ROS_WARN_STREAM("tf of " << source.name << ": " << problem << ": ignored");
  }
}

}  // namespace palpate::node
