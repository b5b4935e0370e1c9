// SPDX-License-Identifier: GPL-3.0-or-later
#include "publishing_loop.h"

#include "anatomy_markers.h"
#include "conversions.h"
#include "ending.h"
#include "topics.h"

namespace palpate::node {

PublishingLoop::PublishingLoop(ros::NodeHandle handle, const sim::Simulator& simulator,
                               double arrow_scale, const CutawayConfig& cutaway, Channels* channels,
                               Diagnostics* diagnostics)
    : channels_(*channels),
      diagnostics_(*diagnostics),
      always_(!simulator.scene().solver.skip.unwatched_markers),
      markers_(simulator, arrow_scale),
      cut_(simulator, cutaway),
      cut_due_(1.0 / cutaway.rate),
      organs_(handle.advertise<visualization_msgs::MarkerArray>(kOrgansTopic, 1)),
      cutaway_(handle.advertise<visualization_msgs::MarkerArray>(kCutawayTopic, 1)),
      anatomy_(handle.advertise<visualization_msgs::MarkerArray>(kAnatomyTopic, 1, true)),
      report_(handle.advertise<palpate::StepReport>(kStepReportTopic, 1)) {
  anatomy_.publish(anatomyMarkers(simulator));
}

PublishingLoop::~PublishingLoop() { stop(); }

void PublishingLoop::start() {
  thread_ = std::thread([this] { Ending::guard("publishing", [this] { loop(); }); });
}

void PublishingLoop::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

void PublishingLoop::loop() {
  // A wake-up that is lost between two waits costs no more than this.
  constexpr double kLongestWait = 0.02;  // [s]
  Throttle diagnostics_due(1.0);
  PhaseTimes beside;  // of the last turn, for the next report
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stopping_) {
    channels_.news.wait_for(lock, seconds(kLongestWait));
    channels_.cells_wanted = cutawayWanted();
    channels_.picture_wanted = organsWanted() || cutawayWanted();
    PhaseTimes times;
    if (channels_.report.hasNew()) {
      const PhaseTimer timer(&times, Phase::kPublish);
      const ReportFrame& frame = channels_.report.read();
      sim::StepReport report = frame.report;
      report.phases += beside;
      report_.publish(toMsg(report, frame.state, frame.stamp, frame.cycle_ms));
    }
    if (channels_.picture.hasNew()) {
      const PhaseTimer timer(&times, Phase::kPublish);
      const Picture& picture = channels_.picture.read();
      if (organsWanted()) organs_.publish(markers_.update(picture));
      if (cutawayWanted() && cut_due_.due()) cutaway_.publish(cut_.update(picture));
    }
    if (times[Phase::kPublish] > 0.0) beside[Phase::kPublish] = times[Phase::kPublish];
    beside[Phase::kHaptics] = channels_.haptics_seconds;
    if (diagnostics_due.due()) {
      diagnostics_.update(channels_.report.read(), channels_.statistics.read());
    }
  }
}

}  // namespace palpate::node
