// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "palpate/sim/simulator.h"
#include "ros/messages/channels.h"
#include "ros/program/throttle.h"

namespace palpate::node {

/// Publishes on /tf the links of the instruments with joint input, each as a child of its root
/// link, at most 50 times a second. Before the first input all joints are at zero, or at the nearer
/// limit. Without new input the poses are repeated once a second, for subscribers that come later.
/// The stamps are those of the input and never go back, but with a simulated clock.
class LinkBroadcaster {
 public:
  /// The references outlive this.
  LinkBroadcaster(ros::NodeHandle handle, const sim::Simulator& simulator, Channels* channels);

  /// Publishes what is due. For one thread, the reader of Channels::links.
  void update();

 private:
  struct Tool {
    std::size_t index;  // in the scene
    Pose X_BW;
    std::string root;
    std::vector<std::string> frames;  // of the links, the root first
    sim::LinkPoses poses;             // X_WL
    ros::Time sent;                   // newest stamp
    Steady::time_point sent_at;
  };
  bool readPoses(Tool* tool, const ros::Time& now);

  Channels& channels_;
  std::vector<Tool> tools_;
  ros::Publisher publisher_;
  Throttle due_;
  ros::Time last_now_;
};

}  // namespace palpate::node
