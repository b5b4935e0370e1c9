// SPDX-License-Identifier: GPL-3.0-or-later
#include "publishing_loop.h"

#include <std_msgs/String.h>

#include "ros/guard/ending.h"
#include "ros/input/tool_frames.h"
#include "ros/messages/conversions.h"
#include "ros/messages/topics.h"
#include "ros/pictures/anatomy_markers.h"
#include "ros/pictures/rviz_config.h"

namespace palpate::node {

namespace {

// Longer arrows leave the picture.
constexpr double kLongestArrow = 0.6;  // of the organs' size

SceneMarkers makeMarkers(const sim::Simulator& simulator, const View& view, double arrow_scale) {
  if (arrow_scale > 0.0) return {simulator, arrow_scale};
  return {simulator, view.arrow_scale, kLongestArrow * view.size()};
}

std::vector<std::string> namesOf(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const scene::InstrumentConfig& instrument : scene.instruments) {
    names.push_back(instrument.name);
  }
  return names;
}

// What is there already counts where the links are another program's.
void setDescriptions(const ros::NodeHandle& handle, const sim::Simulator& simulator, bool replace) {
  for (int i = 0; i < simulator.numInstruments(); ++i) {
    const std::string& name = simulator.scene().instruments[static_cast<std::size_t>(i)].name;
    const std::string parameter = instrumentTopic(name, kRobotDescription);
    if (replace || !handle.hasParam(parameter)) {
      handle.setParam(parameter, robotDescription(simulator, i));
    }
  }
}

std_msgs::String configOf(const ros::NodeHandle& handle, const scene::Scene& scene,
                          const View& view) {
  RvizNames names{handle.resolveName(kOrgansTopic),
                  handle.resolveName(kCutawayTopic),
                  handle.resolveName(kAnatomyTopic),
                  handle.resolveName(kStateTopic),
                  {}};
  for (const scene::InstrumentConfig& instrument : scene.instruments) {
    const auto resolved = [&](const char* name) {
      return handle.resolveName(instrumentTopic(instrument.name, name));
    };
    names.tools.push_back({instrument.name, resolved(kRobotDescription), resolved(kBodyWrench)});
  }
  std_msgs::String message;
  message.data = rvizConfig(view, names);
  return message;
}

}  // namespace

PublishingLoop::PublishingLoop(ros::NodeHandle handle, const sim::Simulator& simulator,
                               const NodeParams& params, const std::vector<std::string>& sources,
                               Channels* channels, Diagnostics* diagnostics)
    : channels_(*channels),
      diagnostics_(*diagnostics),
      view_(makeView(simulator)),
      always_(!simulator.scene().solver.skip.unwatched_markers),
      markers_(makeMarkers(simulator, view_, params.arrow_scale)),
      cut_(simulator, params.cutaway),
      cut_due_(1.0 / params.cutaway.rate),
      state_(view_, namesOf(simulator.scene()), sources),
      organs_(handle.advertise<visualization_msgs::MarkerArray>(kOrgansTopic, 1)),
      cutaway_(handle.advertise<visualization_msgs::MarkerArray>(kCutawayTopic, 1)),
      anatomy_(handle.advertise<visualization_msgs::MarkerArray>(kAnatomyTopic, 1, true)),
      state_text_(handle.advertise<visualization_msgs::Marker>(kStateTopic, 1, true)),
      rviz_config_(handle.advertise<std_msgs::String>(kRvizTopic, 1, true)),
      report_(handle.advertise<palpate::StepReport>(kStepReportTopic, 1)) {
  if (params.arrow_scale > 0.0) view_.arrow_scale = params.arrow_scale;
  if (params.publish_links) links_.emplace(handle, simulator, channels);
  anatomy_.publish(anatomyMarkers(simulator));
  setDescriptions(handle, simulator, params.publish_links);
  rviz_config_.publish(configOf(handle, simulator.scene(), view_));  // last: who hears it finds all
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
    if (links_) links_->update();
    const Statistics& statistics = channels_.statistics.read();
    if (state_.update(channels_.report.read().state, statistics.tools, statistics.coarsening)) {
      state_text_.publish(state_.marker());
    }
    if (times[Phase::kPublish] > 0.0) beside[Phase::kPublish] = times[Phase::kPublish];
    beside[Phase::kHaptics] = channels_.haptics_seconds;
    if (diagnostics_due.due()) {
      diagnostics_.update(channels_.report.read(), channels_.statistics.read());
    }
  }
}

}  // namespace palpate::node
