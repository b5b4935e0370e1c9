// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_cycle.h"

#include <ros/console.h>
#include <ros/time.h>

#include <algorithm>
#include <string>
#include <utility>

#include "ros/messages/stamps.h"
#include "step_cores.h"

namespace palpate::node {
namespace {

// Most cycles that a step covers.
int mostCycles(const sim::Simulator& simulator) {
  return simulator.stepsMayGrow() ? simulator.scene().rates.catch_up : 1;
}

}  // namespace

LiveCycle::LiveCycle(sim::Simulator* simulator, Inputs* inputs, Channels* channels)
    : simulator_(*simulator),
      inputs_(*inputs),
      channels_(*channels),
      samples_(inputs->size()),
      live_(inputs->size(), false),
      poses_(inputs->size()),
      stamps_(inputs->size()),
      targets_(inputs->size()),
      tools_(*simulator),
      length_(seconds(1.0 / simulator->scene().rates.simulation), mostCycles(*simulator)),
      governor_(isRealTime() ? simulator->scene().rates.coarsening : 1.0),
      stepper_(simulator),
      scene_facts_(advice::sceneFacts(*simulator, stepCores())),
      picture_(1.0 / simulator->scene().rates.markers),
      unwatched_(1.0 / simulator->scene().rates.markers) {
  simulator->setMeshPace({isRealTime(), 1.0});
}

void LiveCycle::run() {
  const Steady::time_point start = Steady::now();
  checkClock();
  pollInputs();

  facts_ = CycleFacts();
  facts_.any_seen = facts_.any_live = samples_.empty();  // nobody to wait for
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    live_[i] = live(i, start);
    facts_.any_seen |= samples_[i].valid;
    facts_.any_live |= live_[i];
  }
  step(start);

  const Steady::time_point now = Steady::now();
  machine_.update(facts_, inSeconds(now.time_since_epoch()));
  window_ticks_ += !facts_.late;
  writeHaptic(now);
  writeReport(now);
  writePicture(now);
  writeStatistics(now);
}

void LiveCycle::reset() {
  if (stepper_.underWay()) {
    stepper_.abandon();
    stepper_.wait();
  }
  simulator_.reset();
  length_.pause();
  stepper_.forget();
  tools_.lose();
  solved_any_ = false;
  ++resets_;
}

std::optional<sim::SimulatorState> LiveCycle::state(Steady::time_point until) {
  if (stepper_.underWay()) {
    const sim::StepResult* result = stepper_.wait(until);
    if (!result) {
      stepper_.abandon();
      result = stepper_.wait();
    }
    takeResult(*result);
  }
  return stepper_.cutShort() ? stepper_.before() : simulator_.state();
}

void LiveCycle::checkClock() {
  if (!ros::Time::isSimTime()) return;  // the wall clock may be adjusted at any time
  const ros::Time now = ros::Time::now();
  if (now < last_now_) {
    ROS_INFO("time went back from %.3f to %.3f s: reset", last_now_.toSec(), now.toSec());
    for (const auto& input : inputs_) input->forget();
    for (InputSample& sample : samples_) sample.valid = false;
    reset();
  }
  last_now_ = now;
}

void LiveCycle::pollInputs() {
  const double reordered = simulator_.scene().rates.stale_after;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    if (!inputs_[i]->poll(&polled_)) continue;
    InputSample& sample = samples_[i];
    if (sample.valid && polled_.stamp < sample.stamp) {
      if (secondsBetween(polled_.stamp, sample.stamp) < reordered)
        continue;  // a late one: the newer counts
      if (stamp_warning_.due()) {
        ROS_WARN("stamps of %s went back from %.3f to %.3f s; the scene goes on as it is",
                 inputs_[i]->source().c_str(), sample.stamp.toSec(), polled_.stamp.toSec());
      }
    }
    std::swap(sample, polled_);
  }
}

bool LiveCycle::live(std::size_t i, Steady::time_point now) const {
  return samples_[i].valid &&
         now - samples_[i].received < seconds(simulator_.scene().rates.stale_after);
}

ToolState LiveCycle::toolState(std::size_t i, Steady::time_point now) const {
  if (!samples_[i].valid) return ToolState::kWaiting;
  if (!live(i, now)) return ToolState::kStale;
  return solved_any_ && result_.instruments[i].waiting ? ToolState::kOutside : ToolState::kLive;
}

void LiveCycle::step(Steady::time_point start) {
  if (!stepper_.underWay()) {
    if (!facts_.any_live) return length_.pause();
    beginStep(start);
  }
  facts_.late = !endStep(start);
}

// A tool whose input is missing is not there.
void LiveCycle::beginStep(Steady::time_point start) {
  stamp_ = ros::Time();
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    stamps_[i] = samples_[i].stamp;
    poses_[i] = live_[i] ? samples_[i].poses : sim::LinkPoses();
    if (!live_[i]) continue;
    stamp_ = std::max(stamp_, stamps_[i]);
    input_ages_.push_back(1e3 * inSeconds(start - samples_[i].received));
  }
  tools_.target(&poses_);
  dt_ = length_.begin(start) * simulator_.scene().solver.step;
  stepper_.begin(poses_, dt_);
}

// Whether the step under way has ended by the deadline of a cycle that began at `start`.
bool LiveCycle::endStep(Steady::time_point start) {
  const scene::Scene& scene = simulator_.scene();
  const double deadline = scene.solver.deadline / scene.rates.simulation;
  const sim::StepResult* result =
      deadline > 0.0 ? stepper_.wait(start + seconds(deadline)) : stepper_.wait();
  if (result) takeResult(*result);
  return result;
}

void LiveCycle::takeResult(const sim::StepResult& result) {
  result_ = result;
  solved_any_ = true;
  cycle_ms_ = 1e3 * stepper_.duration();
  cycle_times_.push_back(cycle_ms_);
  costs_.add(result_.report, stepper_.duration());

  facts_.stepped = true;
  facts_.solved = result_.report.usable();
  ++steps_;
  window_time_ += dt_;
  if (!result_.contacts.empty() && result_.report.finest_edge > 0.0) governMesh();
  skipped_ += result_.report.skipped;
  if (!result_.report.ok()) {
    ++unsolved_;
    if (fault_warning_.due()) {
      ROS_WARN("the solver says %s (residual %.2e N, asked for %.2e N)%s",
               std::string(solver::toString(result_.report.status)).c_str(),
               result_.report.residual, result_.report.tolerance,
               facts_.solved ? "" : ": the wrench fades out");
    }
  }
}

// Coarser meshes while touching cycles are late.
void LiveCycle::governMesh() {
  const double before = governor_.coarsening();
  const double now = governor_.observe(stepper_.duration() * simulator_.scene().rates.simulation);
  if (now != before) simulator_.setMeshPace({isRealTime(), now});
}

// After a reset the last wrench stays as a target that is not live, so that it fades. While a step
// is late what the last one told holds, until the force loop has not heard from here for too long.
void LiveCycle::writeHaptic(Steady::time_point now) {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (facts_.late && live_[i]) continue;
    HapticTarget& target = targets_[i];
    target.made = now;
    target.render.live = false;
    if (facts_.stepped) {
      target.valid = true;
      target.stamp = stamps_[i];
      target.render = tools_.observe(i, live_[i], poses_[i], result_.instruments[i], dt_);
    }
    channels_.haptic[i].write(target);
  }
}

// Every step, every change of state, and once a second otherwise.
void LiveCycle::writeReport(Steady::time_point now) {
  const bool changed = machine_.state() != reported_;
  if (!facts_.stepped && !changed && !idle_report_.due(now)) return;
  reported_ = machine_.state();
  ReportFrame frame;
  frame.state = reported_;
  frame.stamp = stamp_;
  if (solved_any_) frame.report = result_.report;
  if (!facts_.stepped) frame.report.skipped = tissue::SkipCounters();
  frame.cycle_ms = facts_.stepped ? cycle_ms_ : 0.0;
  channels_.report.write(frame);
  channels_.news.notify_one();
}

void LiveCycle::writePicture(Steady::time_point now) {
  if (stepper_.underWay()) return;
  if (!channels_.picture_wanted.load(std::memory_order_relaxed)) {
    unwatched_pictures_ += facts_.stepped && unwatched_.due(now);
    return;
  }
  if (!(facts_.stepped ? picture_.due(now) : idle_picture_.due(now))) return;
  Picture picture;
  picture.stamp = stamp_;
  const bool cells = channels_.cells_wanted.load(std::memory_order_relaxed);
  for (int i = 0; i < simulator_.numOrgans(); ++i) {
    picture.organs.push_back(
        surfaces_.take(simulator_.surfaceState(i), static_cast<std::size_t>(i)));
    if (cells) surfaces_.addCells(simulator_, i, &picture.organs.back());
  }
  if (solved_any_) {
    picture.contacts = result_.contacts;
    for (const sim::InstrumentResult& result : result_.instruments) {
      picture.spatial.push_back(result.spatial);
      picture.X_WC.push_back(result.X_WC);
    }
  }
  channels_.picture.write(picture);
  channels_.news.notify_one();
}

}  // namespace palpate::node
