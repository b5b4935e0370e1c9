// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>

#include <memory>

#include "input.h"
#include "palpate/sim/simulator.h"
#include "ros/messages/channels.h"

namespace palpate::node {

/// One input an instrument, as the scene says: joint positions, or the links' frames in tf (one
/// listener for all). Subscribes at once.
class InputFactory {
 public:
  InputFactory();
  ~InputFactory();
  Inputs make(ros::NodeHandle handle, const sim::Simulator& simulator, Channels* channels);

 private:
  struct Tf;
  std::unique_ptr<Tf> tf_;  // outlives the inputs' use of the buffer
};

/// Says on tf_static where the root links of the instruments with joint input stand, once for
/// all.
void broadcastBases(const sim::Simulator& simulator);

}  // namespace palpate::node
