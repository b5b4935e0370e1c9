// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/haptics/device.h"
#include "palpate/haptics/local_model.h"

namespace palpate::haptics {

/// What a hand is to feel of a solve, through its device. Plain numbers.
struct RenderedContact {
  ContactModel model;             ///< By where the hand is.
  bool expected = false;          ///< It has not come yet.
  double lead = 0.0;              ///< Ask it for where the hand will be so much later [s].
  double tissue_stiffness = 0.0;  ///< Largest of what the tool feels [N/m],
  double stiffness = 0.0;         ///< and of what the hand does.

  /// With the hand at `p` [m], going on with `v` [m/s].
  Wrench at(const Vec3& p, const Vec3& v) const { return model.at(p + lead * v); }
};

/// A spring between a hand and its tool [Colgate, Stanley, Brown 1995], there only where the tissue
/// is stiffer than the device can render: as stiff as leaves both in series at that limit. The
/// force is the tissue's own, at a tool that goes less deep than the hand; where the tissue is soft
/// enough, tool and hand are at one place. No clock, no allocation.
class VirtualCoupling {
 public:
  VirtualCoupling(const DeviceSettings& device, double tick) : limits_(device, tick) {}

  /// A solve `dt` [s] after the last found `tool`, which was `lag` [m] behind its target; or
  /// nothing, and it is what is expected.
  const RenderedContact& observe(const ContactModel& tool, bool expected, const Vec3& lag,
                                 double dt);
  /// The tool was lost, or the scene is another one.
  void forget();

  /// Where the tool is to go, with the hand at `p_hand` [m]. Where a contact ended that held it off
  /// the hand, it comes back slowly.
  Vec3 target(const Vec3& p_hand);

  /// It is there: the tissue is too stiff.
  bool active() const { return compliance_ > 0.0; }
  const RenderedContact& rendered() const { return rendered_; }

 private:
  DeviceLimits limits_;
  double compliance_ = 0.0;     // of the spring [m/N]
  Vec3 offset_ = Vec3::Zero();  // of the tool from the hand [m]
  RenderedContact rendered_;
};

}  // namespace palpate::haptics
