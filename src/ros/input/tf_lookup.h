// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/time.h>
#include <tf2/buffer_core.h>

#include <string>
#include <vector>

#include "palpate/instrument/instrument.h"
#include "palpate/scene/scene.h"
#include "palpate/sim/simulator.h"

namespace palpate::node {

/// Finds the links of one instrument in tf: those with a collision shape and the control frame.
class TfLookup {
 public:
  TfLookup(const instrument::Instrument& instrument, const scene::InstrumentConfig& config);

  /// The newest poses that all needed links have at one common time, in world; the other links
  /// are set to identity. `stamp` is that time, zero if all transforms are static. Returns "" or
  /// what is missing; then the arguments are untouched.
  std::string lookup(const tf2::BufferCore& buffer, sim::LinkPoses* poses, ros::Time* stamp) const;

  /// Of the links that are needed, in tf.
  std::vector<std::string> frames() const;

 private:
  struct Link {
    int index;
    std::string frame;
  };
  std::vector<Link> links_;
  std::size_t num_links_;
};

}  // namespace palpate::node
