// SPDX-License-Identifier: GPL-3.0-or-later
#include "tf_input.h"

#include "palpate/base/error.h"
#include "ros/messages/topics.h"

namespace palpate::node {

TfInput::TfInput(const tf2::BufferCore& buffer, TfListener* listener,
                 const sim::Simulator& simulator, int index, LatestValue<HandPose>* hand)
    : buffer_(buffer),
      listener_(*listener),
      lookup_(simulator.instrument(index),
              simulator.scene().instruments[static_cast<std::size_t>(index)]),
      control_(static_cast<std::size_t>(simulator.controlLink(index))),
      hand_(*hand) {}

bool TfInput::poll(InputSample* sample) {
  ros::Time stamp;
  std::string problem = lookup_.lookup(buffer_, &poses_, &stamp);
  if (problem.empty() && !sim::inReach(poses_)) problem = kOutOfReach;
  {
    std::lock_guard<std::mutex> lock(problem_mutex_);
    problem_ = problem;
  }
  if (!problem.empty()) return false;
  // Static transforms hold at any time: they are always news.
  if (!stamp.isZero() && stamp == last_) return false;
  last_ = stamp;
  sample->valid = true;
  sample->stamp = stamp.isZero() ? ros::Time::now() : stamp;
  sample->received = Steady::now();
  sample->poses = poses_;
  const Pose& X_WC = poses_[control_];
  hand_.write({true, sample->stamp, X_WC.translation(), X_WC.linear()});
  return true;
}

// What was heard before is in the buffer until the next message, if the listener is not asked.
void TfInput::forget() {
  listener_.checkClock();
  last_ = ros::Time();
}

std::string TfInput::source() const {
  return std::string("tf frames ") + kWorldFrame + " -> " + joinNames(lookup_.frames());
}

std::string TfInput::problem() const {
  std::lock_guard<std::mutex> lock(problem_mutex_);
  return problem_;
}

}  // namespace palpate::node
