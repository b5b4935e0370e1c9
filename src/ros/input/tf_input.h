// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tf2/buffer_core.h>

#include <mutex>
#include <string>

#include "input.h"
#include "ros/messages/channels.h"
#include "tf_listener.h"
#include "tf_lookup.h"

namespace palpate::node {

/// Link poses from tf. The buffer is filled by a listener; poll() never waits for it.
class TfInput : public Input {
 public:
  /// Where the hand is goes to `hand` with each poll(). The references and `listener` outlive this.
  TfInput(const tf2::BufferCore& buffer, TfListener* listener, const sim::Simulator& simulator,
          int index, LatestValue<HandPose>* hand);

  bool poll(InputSample* sample) override;
  void forget() override;
  std::string source() const override;
  std::string problem() const override;
  std::string conflict() const override { return listener_.conflict(); }

 private:
  const tf2::BufferCore& buffer_;
  TfListener& listener_;
  TfLookup lookup_;
  std::size_t control_;
  LatestValue<HandPose>& hand_;
  sim::LinkPoses poses_;
  ros::Time last_;
  mutable std::mutex problem_mutex_;
  std::string problem_ = "no transforms yet";
};

}  // namespace palpate::node
