// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tf2_ros/buffer.h>

#include <memory>
#include <mutex>
#include <string>

#include "channels.h"
#include "input.h"
#include "tf_lookup.h"

namespace palpate::node {

/// Link poses from tf. The buffer is filled by its own listener; poll() never waits for it.
class TfInput : public Input {
 public:
  /// Where the hand is goes to `hand` with each poll().
  TfInput(std::shared_ptr<const tf2_ros::Buffer> buffer, const sim::Simulator& simulator, int index,
          LatestValue<HandPose>* hand);

  bool poll(InputSample* sample) override;
  void forget() override;
  std::string source() const override;
  std::string problem() const override;

 private:
  std::shared_ptr<const tf2_ros::Buffer> buffer_;
  TfLookup lookup_;
  std::size_t control_;
  LatestValue<HandPose>& hand_;
  sim::LinkPoses poses_;
  ros::Time last_;
  mutable std::mutex problem_mutex_;
  std::string problem_ = "no transforms yet";
};

}  // namespace palpate::node
