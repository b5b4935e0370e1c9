// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <mutex>
#include <thread>

#include "channels.h"
#include "cutaway_markers.h"
#include "diagnostics.h"
#include "markers.h"
#include "throttle.h"

namespace palpate::node {

/// Publishes the anatomy once. The publishing thread: step reports as they come, markers while
/// somebody subscribes, diagnostics once a second.
class PublishingLoop {
 public:
  PublishingLoop(ros::NodeHandle handle, const sim::Simulator& simulator, double arrow_scale,
                 const CutawayConfig& cutaway, Channels* channels, Diagnostics* diagnostics);
  ~PublishingLoop();

  void start();
  void stop();

 private:
  void loop();
  bool organsWanted() const { return always_ || organs_.getNumSubscribers() > 0; }
  bool cutawayWanted() const { return always_ || cutaway_.getNumSubscribers() > 0; }

  Channels& channels_;
  Diagnostics& diagnostics_;
  bool always_;  // make pictures that nobody sees, too
  SceneMarkers markers_;
  CutawayMarkers cut_;
  Throttle cut_due_;
  ros::Publisher organs_, cutaway_, anatomy_, report_;
  std::mutex mutex_;  // for waiting only; nobody else takes it
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace palpate::node
