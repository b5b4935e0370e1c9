// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/haptics/force_renderer.h"
#include "palpate/haptics/local_model.h"
#include "palpate/haptics/tool_coupling.h"
#include "palpate/haptics/virtual_coupling.h"

namespace palpate::haptics {

/// Simulation side of one hand: target of the tool from the hand position, and RenderTarget of the
/// force loop from a solve. Reads no clock, allocates nothing.
class ToolRenderer {
 public:
  ToolRenderer(const CouplingSettings& coupling, const DeviceSettings& device, double tick)
      : coupling_settings_(coupling), virtual_coupling_(device, tick) {}

  /// Target of the tool for the hand at `p_hand`, both world [m].
  Vec3 target(const Vec3& p_hand) { return virtual_coupling_.target(p_hand); }

  /// Takes a solve `dt` [s] after the last, with the tool's target `p_target`, position `p_tool`,
  /// both world [m], and `wrench` at p_tool.
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

  /// Fades the force of a present tool with an unknown wrench.
  const RenderTarget& fade() {
    render_.live = false;
    return render_;
  }

  /// The tool is absent: fades the force and clears the models.
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
