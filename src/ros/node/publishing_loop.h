// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "diagnostics.h"
#include "params.h"
#include "ros/messages/channels.h"
#include "ros/pictures/cutaway_markers.h"
#include "ros/pictures/link_broadcaster.h"
#include "ros/pictures/markers.h"
#include "ros/pictures/state_text.h"
#include "ros/pictures/view.h"
#include "ros/program/throttle.h"

namespace palpate::node {

/// Publishes once, for whoever subscribes later, the anatomy and how rviz shows the scene. The
/// publishing thread: step reports as they come, markers while somebody subscribes, the
/// instruments' links, the state as text where it changes, diagnostics once a second.
class PublishingLoop {
 public:
  /// `sources`: of each instrument, see Input::source().
  PublishingLoop(ros::NodeHandle handle, const sim::Simulator& simulator, const NodeParams& params,
                 const std::vector<std::string>& sources, Channels* channels,
                 Diagnostics* diagnostics);
  ~PublishingLoop();

  void start();
  void stop();

 private:
  void loop();
  bool organsWanted() const { return always_ || organs_.getNumSubscribers() > 0; }
  bool cutawayWanted() const { return always_ || cutaway_.getNumSubscribers() > 0; }

  Channels& channels_;
  Diagnostics& diagnostics_;
  View view_;
  bool always_;  // make pictures that nobody sees, too
  SceneMarkers markers_;
  CutawayMarkers cut_;
  Throttle cut_due_;
  StateText state_;
  std::optional<LinkBroadcaster> links_;
  ros::Publisher organs_, cutaway_, anatomy_, state_text_, rviz_config_, report_;
  std::mutex mutex_;  // for waiting only; nobody else takes it
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace palpate::node
