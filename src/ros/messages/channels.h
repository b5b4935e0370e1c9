// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/time.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "arrivals.h"
#include "node_state.h"
#include "palpate/advice/scene_verdict.h"
#include "palpate/base/latest_value.h"
#include "palpate/haptics/force_renderer.h"
#include "palpate/sim/simulator.h"
#include "ros/program/throttle.h"

namespace palpate::node {

/// Where an instrument is commanded to, as last heard. Plain numbers.
struct HandPose {
  bool valid = false;
  ros::Time stamp;           ///< Of the input.
  Vec3 p_WC = Vec3::Zero();  ///< Control frame's origin in world [m].
  Mat3 R_WC = Mat3::Identity();
};

/// Where the links of an instrument with joint input are commanded to, as last heard.
struct ToolLinks {
  ros::Time stamp;  ///< Of the input.
  sim::LinkPoses poses;
};

/// What the force loop gets of one instrument. Plain numbers: copied in real time.
struct HapticTarget {
  bool valid = false;  ///< False: there was no cycle yet.
  ros::Time stamp;     ///< Of the input that was solved.
  Steady::time_point made;
  haptics::RenderTarget render;
};

/// One cycle's report with what the node knows beside it.
struct ReportFrame {
  NodeState state = NodeState::kWaiting;
  ros::Time stamp;
  sim::StepReport report;
  double cycle_ms = 0.0;
};

/// The surface of an organ in a picture. Pictures share triangles that have not become others.
struct SurfacePicture {
  Points positions;  ///< World, 3 x n [m].
  std::shared_ptr<const Eigen::Matrix3Xi> triangles;
  std::uint64_t revision = 0;  ///< See tissue::SurfaceState.
  /// At rest, of the same revision; shared likewise. Null while nobody wants cells.
  std::shared_ptr<const mesh::CellMesh> cells = {};
};

/// What is seen in rviz.
struct Picture {
  ros::Time stamp;
  std::vector<SurfacePicture> organs;  ///< Empty before the first picture.
  std::vector<sim::ContactPoint> contacts;
  std::vector<Wrench> spatial;  ///< One an instrument; empty while there is nothing to show.
  std::vector<Pose> X_WC;
};

/// How the last second went, for /diagnostics.
struct Statistics {
  double rate_wanted = 0.0, rate_reached = 0.0;              ///< [Hz]; reached is 0 until known.
  double cycle_p50 = 0.0, cycle_p99 = 0.0, cycle_max = 0.0;  ///< [ms]
  double coarsening = 1.0;                                   ///< Factor of adapt.finest [-].
  double sim_speed = 0.0;                                    ///< Simulated over real time.
  double input_age = 0.0;        ///< Of an input when its cycle began, median [ms].
  advice::SceneVerdict verdict;  ///< Whether the scene is too heavy; unknown while no cycle solves.
  long cycles = 0, unsolved = 0, resets = 0;
  tissue::SkipCounters skipped;  ///< Work that the cycles could leave out, since the start.
  long unwatched_pictures = 0;   ///< Pictures not made because nobody subscribes.
  std::vector<ToolState> tools;  ///< One an instrument.
};

/// Below this share of the wanted rate the node calls itself too slow.
inline constexpr double kSlowShare = 0.9;

/// "simulation reaches 62 of 100 Hz ...": the rate reached and what to change.
std::string slowAdvice(const Statistics& statistics);

/// From the inputs and the simulation thread to the others, newest value only.
struct Channels {
  explicit Channels(std::size_t num_instruments)
      : hands(num_instruments), links(num_instruments), haptic(num_instruments) {}

  std::deque<LatestValue<HandPose>> hands;       ///< One an instrument; from its input's thread.
  std::deque<LatestValue<ToolLinks>> links;      ///< Likewise; read by the publishing thread.
  std::deque<LatestValue<HapticTarget>> haptic;  ///< One an instrument; read by the force loop.
  LatestValue<ReportFrame> report;               ///< These three: read by the publishing thread.
  LatestValue<Picture> picture;
  LatestValue<Statistics> statistics;
  std::atomic<bool> picture_wanted{false};   ///< Somebody subscribes to the markers.
  std::atomic<bool> cells_wanted{false};     ///< To those that show what is inside.
  std::atomic<double> haptics_seconds{0.0};  ///< Of the force loop's last cycle.
  Arrivals arrivals;             ///< Of inputs with a thread; wakes the simulation thread.
  std::condition_variable news;  ///< Wakes the publishing thread; nobody waits for it.
};

}  // namespace palpate::node
