// SPDX-License-Identifier: GPL-3.0-or-later
// What the live cycle says about itself once a second.
#include <ros/console.h>

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <string>

#include "live_cycle.h"
#include "palpate/base/percentiles.h"

namespace palpate::node {

std::string slowAdvice(const Statistics& s) {
  std::ostringstream text;
  text << std::setprecision(3) << "the simulation reaches " << s.rate_reached << " of "
       << s.rate_wanted << " Hz (median cycle " << s.cycle_p50 << " ms), so simulated time runs at "
       << s.sim_speed << " of real time; " << advice::shortText(s.verdict);
  return text.str();
}

void LiveCycle::writeStatistics(Steady::time_point now) {
  const double elapsed = inSeconds(now - window_start_);
  const bool first = !said_anything_;  // who is missing cannot wait
  if (elapsed < 1.0 && !first) return;
  said_anything_ = true;
  const scene::Scene& scene = simulator_.scene();
  Statistics s;
  s.rate_wanted = scene.rates.simulation;
  if (!first) {
    s.rate_reached = static_cast<double>(window_ticks_) / elapsed;
    s.sim_speed = window_time_ / elapsed;
  }
  const Percentiles p = percentiles(cycle_times_);
  s.cycle_p50 = p.p50;
  s.cycle_p99 = p.p99;
  s.cycle_max = p.max;
  s.input_age = percentiles(input_ages_).p50;
  s.verdict = advice::judgeScene(scene_facts_, costs_.figures());
  s.coarsening = governor_.coarsening();
  s.cycles = steps_;
  s.unsolved = unsolved_;
  s.resets = resets_;
  s.skipped = skipped_;
  s.unwatched_pictures = unwatched_pictures_;
  for (std::size_t i = 0; i < inputs_.size(); ++i) s.tools.push_back(toolState(i, now));
  if (!first) {
    warnWaiting(s);
    warnSlow(s);
  }
  channels_.statistics.write(s);
  channels_.news.notify_one();

  window_start_ = now;
  window_ticks_ = 0;
  window_time_ = 0.0;
  cycle_times_.clear();
  input_ages_.clear();
  costs_.clear();
}

void LiveCycle::warnWaiting(const Statistics& s) {
  const auto waits = [](ToolState state) {
    return state == ToolState::kWaiting || state == ToolState::kOutside;
  };
  if (std::none_of(s.tools.begin(), s.tools.end(), waits) || !waiting_warning_.due()) return;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const std::string& name = simulator_.scene().instruments[i].name;
    if (s.tools[i] == ToolState::kWaiting) {
      ROS_WARN_STREAM("WAITING for the input of " << name << " on " << inputs_[i]->source() << ": "
                                                  << inputs_[i]->problem());
    } else if (s.tools[i] == ToolState::kOutside) {
      ROS_WARN_STREAM(name << " is commanded to where it would be inside tissue: it comes when it "
                              "is lifted out");
    }
  }
}

void LiveCycle::warnSlow(const Statistics& s) {
  if (s.rate_reached >= kSlowShare * s.rate_wanted || !slow_warning_.due()) return;
  ROS_WARN_STREAM(slowAdvice(s));
}

}  // namespace palpate::node
