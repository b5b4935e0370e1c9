// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "interval_log.h"
#include "palpate/haptics/force_renderer.h"
#include "palpate/haptics/wrench_rate.h"
#include "palpate/scene/scene.h"
#include "ros/messages/channels.h"

namespace palpate::node {

/// What the force loop tells /diagnostics. Written by the loop, read by the publishing thread.
struct HapticStatistics {
  std::atomic<bool> realtime{false};  ///< Runs under SCHED_FIFO.
  std::atomic<long> cycles{0};        ///< Since the start.
  std::atomic<long> late{0};          ///< Cycles that began more than one period late.
  std::atomic<double> peak_force{0};  ///< Largest |F| sent since the start [N].
  std::atomic<double> energy_out{0};  ///< Most that came out of a hand's port unpaid [J],
  std::atomic<double> taken_back{0};  ///< and what was taken back of all hands'.
  std::atomic<double> tissue{0};      ///< Largest stiffness that a tool feels now [N/m],
  std::atomic<double> rendered{0};    ///< and that a hand does.
};

/// The force thread: at rates.haptic, what each instrument feels where it is commanded to now, by
/// the local model around the newest solve and through its filter, to spatial/measured_cf and
/// body/measured_cf. The stamp is that of the input that it is for. Until
/// the first cycle of the simulation it sends zeros, for a device may still hold what somebody sent
/// before.
class HapticLoop {
 public:
  HapticLoop(ros::NodeHandle handle, const scene::Scene& scene, Channels* channels);
  ~HapticLoop();

  void start();
  /// Takes the force back, sends some zeros more, so that the device has one whatever else is lost,
  /// and ends. The destructor does so, too.
  void finish();

  const HapticStatistics& statistics() const { return statistics_; }
  /// Between two wrenches, and from an input's stamp to the first wrench that knows it [s]; one
  /// thread may look.
  IntervalLog& periods() { return periods_; }
  IntervalLog& latencies() { return latencies_; }
  double rate() const { return 1.0 / inSeconds(period_); }  ///< Wanted [Hz].
  double delay() const { return delay_; }  ///< Longest that a device of the scene says it has [s].

 private:
  struct Hand {
    haptics::ForceRenderer force;
    haptics::WrenchRate in_body;  // the force, in axes that may leap
    ros::Publisher spatial, body, model;
    std::string body_frame;
    double tissue = 0.0, rendered = 0.0;  // stiffness of the last tick [N/m]
  };

  void loop();
  void update(std::size_t i, Steady::time_point now, double dt);
  void send(Hand* hand, const Wrench& spatial, const Wrench& body, const HapticTarget& target,
            const HandPose& pose);
  bool atRest() const;

  Channels& channels_;
  std::vector<Hand> hands_;
  Steady::duration period_;
  double delay_ = 0.0;
  Steady::duration silence_;  // of the simulation, after which the wrench fades
  HapticStatistics statistics_;
  IntervalLog periods_, latencies_;
  std::atomic<bool> finishing_{false};
  std::thread thread_;
};

}  // namespace palpate::node
