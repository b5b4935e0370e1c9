// SPDX-License-Identifier: GPL-3.0-or-later
#include "tf_frames.h"

#include <cmath>
#include <cstdint>

#include "ros/messages/stamps.h"
#include "ros/messages/topics.h"

namespace palpate::node {
namespace {

// Chains of frames and trees of static ones are shorter than this by far.
constexpr std::size_t kMostFrames = 100, kMostOthers = 10000, kLongestFrameName = 1000;
constexpr double kForever = 1.0e9;  // [s]
constexpr double kClosest = 5e-4;   // [s] between two transforms of a frame
// Beyond, sums of stamps and times overflow.
constexpr std::uint32_t kLatest = 0x7fffffff;

std::string fault(const geometry_msgs::TransformStamped& t) {
  const auto& p = t.transform.translation;
  const auto& q = t.transform.rotation;
  if (!std::isfinite(p.x + p.y + p.z) || !std::isfinite(q.x + q.y + q.z + q.w)) {
    return "is not finite";
  }
  const double norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(std::abs(norm - 1.0) < 0.01)) return "has a quaternion that is no rotation";
  if (t.header.stamp.sec > kLatest) return "has a stamp beyond the year 2038";
  return "";
}

}  // namespace

TfFrames::TfFrames(const std::vector<std::string>& frames, double patience, tf2::BufferCore* buffer)
    : patience_(patience), buffer_(*buffer) {
  want(kWorldFrame);
  for (const std::string& frame : frames) want(frameName(frame));
}

std::string TfFrames::take(const Transform& transform, bool is_static, const Source& source) {
  const std::string child = frameName(transform.child_frame_id);
  const std::string parent = frameName(transform.header.frame_id);
  if (child.empty() || parent.empty() || child == parent) return "";
  if (child.size() > kLongestFrameName || parent.size() > kLongestFrameName) return "";
  const auto found = wanted_.find(child);
  if (found == wanted_.end()) {
    if (is_static && others_.size() < kMostOthers) {
      others_[child] = {transform, source.connection, source.name, source.time};
    }
    return "";
  }
  const std::string problem = fault(transform);
  if (!problem.empty()) return "the transform of " + child + " " + problem;
  Frame& frame = found->second;
  if (!frame.publisher) {
    frame.is_static = is_static;
    frame.publisher.emplace(is_static ? kForever : patience_);
  }
  if (is_static != frame.is_static) return "frame " + child + " moves and is said to be static";
  if (!frame.publisher->takes(source.connection, source.name, source.time)) return "";
  if (!is_static) {
    const double way = wayTo(&frame, transform.header.stamp);
    if (way < 0.0) return "the transform of " + child + " is older than its last one";
    if (way < kClosest) return "";
    frame.newest = transform.header.stamp;
  }
  buffer_.setTransform(transform, source.name, is_static);
  want(parent);
  return "";
}

// From the newest stamp to another one [s]. One far back is that of another clock, or of another
// publisher: all goes on from there.
double TfFrames::wayTo(Frame* frame, const ros::Time& stamp) {
  const double way = secondsBetween(frame->newest, stamp);
  if (!frame->newest.isZero() && way <= -patience_) forget();
  return frame->newest.isZero() ? kForever : way;
}

void TfFrames::want(const std::string& name) {
  if (wanted_.size() >= kMostFrames || !wanted_.emplace(name, Frame()).second) return;
  const auto kept = others_.find(name);
  if (kept == others_.end()) return;
  const Kept known = kept->second;
  others_.erase(kept);
  take(known.transform, true, {known.connection.lock(), known.name, known.time});
}

void TfFrames::forget() {
  buffer_.clear();
  for (auto& [name, frame] : wanted_) frame.newest = ros::Time();
}

std::string TfFrames::conflict(Steady::time_point now) const {
  for (const auto& [name, frame] : wanted_) {
    const std::string who = frame.publisher ? frame.publisher->conflict(now) : "";
    if (!who.empty()) return "frame " + name + ": " + who;
  }
  return "";
}

}  // namespace palpate::node
