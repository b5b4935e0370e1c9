// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/haptics/passivity.h"
#include "palpate/haptics/velocity_estimate.h"
#include "palpate/haptics/virtual_coupling.h"
#include "palpate/haptics/wrench_filter.h"

namespace palpate::haptics {

/// Input of a tick of the force loop for one hand, without pointers.
struct RenderTarget {
  bool live = false;               ///< False: the force fades out.
  RenderedContact contact;         ///< Contact of the newest solve.
  Vec3 coupling_W = Vec3::Zero();  ///< Coupling force towards a tool that lags behind, world [N].
};

/// Computes the force for the device, once a tick: local contact model at the predicted hand
/// position, passivity controller, limits. Reads no clock, allocates nothing.
class ForceRenderer {
 public:
  ForceRenderer(const WrenchFilterSettings& filter, const PassivitySettings& passivity,
                const DeviceSettings& device, double tick);

  /// Computes a tick of `dt` > 0 [s] with the hand at `p_hand`, world [m].
  const Wrench& update(const RenderTarget& target, const Vec3& p_hand, double dt);
  /// The same with an unknown hand position: the force fades out.
  const Wrench& fade(double dt);

  const Wrench& output() const { return filter_.output(); }
  const PassivityController& passivity() const { return passivity_; }

 private:
  VelocityEstimate velocity_;
  PassivityController passivity_;
  WrenchFilter filter_;
};

}  // namespace palpate::haptics
