// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>

#include "palpate/haptics/force_renderer.h"
#include "palpate/haptics/simulated_hand.h"
#include "palpate/haptics/tool_renderer.h"
#include "palpate/sim/hand_motion.h"
#include "palpate/sim/simulator.h"

namespace palpate::sim {

/// How a simulated device is joined to a simulator.
struct HandLoopSettings {
  haptics::HandSettings hand;
  haptics::WrenchFilterSettings filter;
  haptics::PassivitySettings passivity;
  haptics::CouplingSettings coupling;
  haptics::DeviceSettings told;  ///< What the program believes of the device.
  double tick = 1.0e-3;          ///< Of the force loop and the device [s].
  double cycle = 0.01;           ///< Of the simulation [s].
  double solve = 0.005;          ///< From the input of a cycle to its wrench [s].
  double delay_in = 0.0;         ///< From the device to the program [s].
  double delay_out = 0.0;        ///< And back [s].
  double device_rate = 1e3;      ///< Of the device: it reports and latches so often [Hz].
  bool prescribed = false;       ///< The hand is where it means to be, whatever it feels.
  bool local_model = true;       ///< Else the last wrench is held.
  bool ahead = true;  ///< The force is for where the hand will be; else for where it was heard.
};

/// What a tick of the loop did.
struct HandTick {
  double time = 0.0;     ///< At its end [s].
  Vec3 position, meant;  ///< Of the device, and where the hand means it to be; as intents [m].
  Vec3 force;            ///< Rendered [N].
  Vec3 solved;           ///< Of the newest solve [N].
  double tissue_stiffness = 0.0, stiffness = 0.0;  ///< Largest, and as rendered [N/m].
};

/// The loop through the hand, in simulated time: a device on one instrument, whose tool it carries
/// along without turning it. Everything that the node does between pose and force is here done by
/// the same parts; delays are what the settings say, so that the same settings give the same bits.
class HandLoop {
 public:
  /// The instrument stands at `start`, clear of tissue. `simulator` outlives this.
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
  std::deque<Sent> positions_, forces_;    // under way
  Vec3 heard_ = Vec3::Zero();              // newest position that the program knows
  Vec3 rendered_ = Vec3::Zero();           // newest force that the device knows
  long ticks_ = 0, every_;                 // ticks of the device
  double next_cycle_ = 0.0, ready_ = 0.0;  // when the next begins; when the one under way is done
  bool under_way_ = false;
  haptics::RenderTarget solved_, target_;  // of the cycle under way; in use
  HandTick done_;
};

}  // namespace palpate::sim
