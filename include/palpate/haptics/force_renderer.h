// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/haptics/passivity.h"
#include "palpate/haptics/velocity_estimate.h"
#include "palpate/haptics/virtual_coupling.h"
#include "palpate/haptics/wrench_filter.h"

namespace palpate::haptics {

/// What one hand has to feel at a tick of the force loop. Plain numbers.
struct RenderTarget {
  bool live = false;               ///< Else what is felt fades.
  RenderedContact contact;         ///< Of the newest solve.
  Vec3 coupling_W = Vec3::Zero();  ///< What draws it to a tool that could not follow [N].
};

/// From the newest solve to the force that is sent, once a tick: the local model for where the hand
/// will be when the force arrives, the passivity controller, the limits. No clock, no allocation.
class ForceRenderer {
 public:
  ForceRenderer(const WrenchFilterSettings& filter, const PassivitySettings& passivity,
                const DeviceSettings& device, double tick);

  /// A tick of `dt` > 0 [s] begins with the hand at `p_hand` [m].
  const Wrench& update(const RenderTarget& target, const Vec3& p_hand, double dt);
  /// The same where nobody knows where the hand is: what is felt fades.
  const Wrench& fade(double dt);

  const Wrench& output() const { return filter_.output(); }
  const PassivityController& passivity() const { return passivity_; }

 private:
  VelocityEstimate velocity_;
  PassivityController passivity_;
  WrenchFilter filter_;
};

}  // namespace palpate::haptics
