// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/haptics/force_renderer.h"
#include "palpate/haptics/local_model.h"
#include "palpate/haptics/tool_coupling.h"
#include "palpate/haptics/virtual_coupling.h"

namespace palpate::haptics {

/// The simulation's side of one hand: from the hand to where its tool is to go, and from a solve to
/// what the force loop renders (ForceRenderer) until the next. No clock, no allocation.
class ToolRenderer {
 public:
  ToolRenderer(const CouplingSettings& coupling, const DeviceSettings& device, double tick)
      : coupling_settings_(coupling), virtual_coupling_(device, tick) {}

  /// Where the tool is to go, with the hand at `p_hand`, both in world [m].
  Vec3 target(const Vec3& p_hand) { return virtual_coupling_.target(p_hand); }

  /// A solve `dt` [s] after the last: the tool was to be at `p_target`, was at `p_tool` [m] and
  /// felt `wrench`.
  const RenderTarget& observe(const Vec3& p_target, const Vec3& p_tool, const Wrench& wrench,
                              double dt) {
    const ContactModel& tool = local_.observe(p_tool, wrench);
    render_.live = true;
    render_.contact =
        virtual_coupling_.observe(tool, wrench.force == Vec3::Zero(), p_target - p_tool, dt);
    render_.coupling_W = virtual_coupling_.active()
                             ? Vec3::Zero()
                             : couplingForce(coupling_settings_, p_target, p_tool);
    return render_;
  }

  /// Nobody knows what the tool feels, which is there: what it felt fades.
  const RenderTarget& fade() {
    render_.live = false;
    return render_;
  }

  /// There is no tool. What it felt fades, and is forgotten.
  const RenderTarget& lose() {
    local_.forget();
    virtual_coupling_.forget();
    return fade();
  }

 private:
  CouplingSettings coupling_settings_;
  LocalModel local_;
  VirtualCoupling virtual_coupling_;
  RenderTarget render_;
};

}  // namespace palpate::haptics
