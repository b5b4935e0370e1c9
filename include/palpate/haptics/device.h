// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace palpate::haptics {

/// Dynamics of a haptic device, for stability of the force loop.
struct DeviceSettings {
  double mass = 0.045;   ///< Apparent mass at the handle, without the hand [kg].
  double damping = 0.0;  ///< Damping at the handle [N s/m].
  double delay = 0.0;    ///< Delay from a pose to the force for it, without the loop's ticks [s].
  double rate = 1.0e3;   ///< Rate of poses and forces [Hz].
};

/// Limits of what a device renders stably, with a force sent each `tick` [s].
class DeviceLimits {
 public:
  /// @throws std::invalid_argument if mass, rate or tick is not > 0, or another value is negative.
  DeviceLimits(const DeviceSettings& device, double tick);

  /// Delay from a hand pose to the middle of the tick with its force [s].
  double delay() const { return delay_; }

  /// Largest spring stiffness K that is stable with any hand [N/m]: b >= K delay with the device's
  /// damping b and a factor of safety of 2 [Colgate, Schenkel 1997]; or one slow enough by the mass
  /// that a force predicted by `lead` stays in phase.
  double maxStiffness() const;

  /// Largest damping that is stable in spite of its own delay [N s/m].
  double maxDamping() const;

  /// Prediction time for the force of a spring K [N/m] [s]: compensates the delay, and more where
  /// the device's damping alone would let the spring oscillate.
  double lead(double K) const;

 private:
  DeviceSettings device_;
  double delay_;
};

}  // namespace palpate::haptics
