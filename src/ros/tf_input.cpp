// SPDX-License-Identifier: GPL-3.0-or-later
#include "tf_input.h"

#include <utility>

namespace palpate::node {

TfInput::TfInput(std::shared_ptr<const tf2_ros::Buffer> buffer,
                 const instrument::Instrument& instrument, const scene::InstrumentConfig& config)
    : buffer_(std::move(buffer)), lookup_(instrument, config) {}

bool TfInput::poll(InputSample* sample) {
  ros::Time stamp;
  const std::string problem = lookup_.lookup(*buffer_, &poses_, &stamp);
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
  return true;
}

// The listener empties its buffer by itself when time goes back.
void TfInput::forget() { last_ = ros::Time(); }

std::string TfInput::source() const { return "tf frames " + lookup_.frames(); }

std::string TfInput::problem() const {
  std::lock_guard<std::mutex> lock(problem_mutex_);
  return problem_;
}

}  // namespace palpate::node
