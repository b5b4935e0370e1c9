// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>

#include "palpate/haptics/force_renderer.h"
#include "palpate/haptics/simulated_hand.h"
#include "palpate/haptics/tool_renderer.h"
#include "palpate/sim/hand_motion.h"
#include "palpate/sim/simulator.h"

namespace palpate::sim {

/// Settings of a simulated device on a simulator.
struct HandLoopSettings {
  haptics::HandSettings hand;
  haptics::WrenchFilterSettings filter;
  haptics::PassivitySettings passivity;
  haptics::CouplingSettings coupling;
  haptics::DeviceSettings told;  ///< Device settings that the program assumes.
  double tick = 1.0e-3;          ///< Period of force loop and device [s].
  double cycle = 0.01;           ///< Period of the simulation [s].
  double solve = 0.005;          ///< Delay from a cycle's input to its wrench [s].
  double delay_in = 0.0;         ///< Delay from device to program [s].
  double delay_out = 0.0;        ///< Delay from program to device [s].
  double device_rate = 1e3;      ///< Rate at which the device reports poses and takes forces [Hz].
  bool prescribed = false;  ///< Whether the hand's position is prescribed, independent of forces.
  bool local_model = true;  ///< False: the last wrench is held between cycles.
  bool ahead = true;        ///< Whether forces are for predicted, not reported, positions.
};

/// Result of a tick.
struct HandTick {
  double time = 0.0;  ///< Time at the tick's end [s].
  Vec3 position,
      meant;    ///< Present and intended position of the device, relative to its start [m].
  Vec3 force;   ///< Rendered force [N].
  Vec3 solved;  ///< Force of the newest solve [N].
  double tissue_stiffness = 0.0,
         stiffness = 0.0;  ///< Largest stiffness of the tissue, and as rendered [N/m].
};

/// Force loop through a simulated hand, in simulated time: a device that translates one instrument.
/// Uses the node's classes between pose and force, with delays of the settings, so results are
/// bitwise reproducible.
class HandLoop {
 public:
  /// `start`: pose of the instrument.
  /// @pre It is clear of tissue, and `simulator` outlives this.
  HandLoop(Simulator* simulator, int instrument, const LinkPoses& start,
           const HandLoopSettings& settings);

  const HandTick& tick(const HandIntent& intent);
  const haptics::SimulatedHand& hand() const { return hand_; }
  const haptics::PassivityController& passivity() const { return force_.passivity(); }

 private:
  struct Sent {
    double time;
    Vec3 value;
  };
  static Vec3 newest(std::deque<Sent>* sent, double until, const Vec3& before);
  void beginCycle();

  Simulator& simulator_;
  int instrument_;
  LinkPoses start_;
  HandLoopSettings settings_;
  std::size_t link_;  // with the control frame
  haptics::SimulatedHand hand_;
  haptics::ToolRenderer tool_;
  haptics::ForceRenderer force_;
  std::vector<LinkPoses> poses_;
  std::deque<Sent> positions_, forces_;    // in transit
  Vec3 heard_ = Vec3::Zero();              // newest position at the program
  Vec3 rendered_ = Vec3::Zero();           // newest force at the device
  long ticks_ = 0, every_;                 // ticks of the device
  double next_cycle_ = 0.0, ready_ = 0.0;  // begin of the next cycle; end of the present one [s]
  bool under_way_ = false;
  haptics::RenderTarget solved_, target_;  // of the present cycle; in use
  HandTick done_;
};

}  // namespace palpate::sim
