// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/haptics/device.h"
#include "palpate/haptics/local_model.h"

namespace palpate::haptics {

/// Contact of a solve as the device renders it, without pointers.
struct RenderedContact {
  ContactModel model;             ///< Local model as a function of the hand position.
  bool expected = false;          ///< Whether the contact is expected, not present.
  double lead = 0.0;              ///< Prediction time of the hand position [s].
  double tissue_stiffness = 0.0;  ///< Largest stiffness at the tool [N/m].
  double stiffness = 0.0;         ///< Largest stiffness at the hand [N/m].

  /// Wrench for the hand at `p` [m] with velocity `v` [m/s].
  Wrench at(const Vec3& p, const Vec3& v) const { return model.at(p + lead * v); }
};

/// Virtual coupling: a spring between hand and tool [Colgate, Stanley, Brown 1995], active where
/// the tissue is stiffer than the device can render. Spring and tissue in series have the limit's
/// stiffness. The rendered force is the tissue's, at a tool less deep than the hand. Reads no
/// clock, allocates nothing.
class VirtualCoupling {
 public:
  VirtualCoupling(const DeviceSettings& device, double tick) : limits_(device, tick) {}

  /// Takes a solve `dt` [s] after the last: local model `tool`, expected or present, and the tool's
  /// lag behind its target [m].
  const RenderedContact& observe(const ContactModel& tool, bool expected, const Vec3& lag,
                                 double dt);
  /// Clears the state: the tool was lost or the scene has changed.
  void forget();

  /// Target of the tool for the hand at `p_hand` [m]. After a contact with coupling the tool
  /// returns slowly to the hand.
  Vec3 target(const Vec3& p_hand);

  /// Whether the coupling is active: the tissue is stiffer than the limit.
  bool active() const { return compliance_ > 0.0; }
  const RenderedContact& rendered() const { return rendered_; }

 private:
  DeviceLimits limits_;
  double compliance_ = 0.0;     // of the spring [m/N]
  Vec3 offset_ = Vec3::Zero();  // of the tool from the hand [m]
  RenderedContact rendered_;
};

}  // namespace palpate::haptics
