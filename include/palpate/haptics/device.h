// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::haptics {

/// What a loop through a haptic device has to know of it to be stable.
struct DeviceSettings {
  double mass = 0.045;   ///< Apparent at the handle, without the hand [kg].
  double damping = 0.0;  ///< Of its own at the handle [N s/m].
  double delay = 0.0;    ///< From a pose to the force that answers it, beside the ticks [s].
  double rate = 1.0e3;   ///< Poses and forces that it handles each second [Hz].
};

/// What such a device can render, in a program that sends a force each `tick` [s].
class DeviceLimits {
 public:
  /// @throws std::invalid_argument if mass, rate or tick is not > 0, or another value is negative.
  DeviceLimits(const DeviceSettings& device, double tick);

  /// From where the hand is to the middle of the tick with the force for it [s].
  double delay() const { return delay_; }

  /// Stiffest spring that comes to rest in whatever hand [N/m]: one whose delay the device's own
  /// damping pays for, b >= K delay [Colgate, Schenkel 1997], twice; or one that the mass makes so
  /// slow that a force for where the hand will be (`lead`) stays in phase.
  double maxStiffness() const;

  /// Damper that does not push the mass over, for it is late itself [N s/m].
  double maxDamping() const;

  /// How far ahead of a pose to ask for the force of a spring K [N/m], so that it is right when it
  /// arrives, and beyond where the device's own damping would leave it swinging [s].
  double lead(double K) const;

 private:
  DeviceSettings device_;
  double delay_;
};

}  // namespace palpate::haptics
