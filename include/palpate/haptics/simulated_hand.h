// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::haptics {

/// A hand that holds a haptic device: what a loop is tested against.
struct HandSettings {
  double mass = 0.1;              ///< Of the device as it is felt, and of the hand with it [kg].
  double device_damping = 0.2;    ///< [N s/m]
  double grip_stiffness = 100.0;  ///< Between where the hand means to be and where it is [N/m].
  double grip_damping = 1.0;      ///< [N s/m]
  double resolution = 5.5e-5;     ///< Of the measured position [m]; 0: exact.
  double guide_stiffness = 0.0;   ///< More of the grip across z: of one that leans down [N/m],
  double guide_damping = 0.0;     ///< [N s/m]
};

/// A mass that springs and dampers draw to where the hand means to be, and the rendered force
/// away from there: m a = k (p_meant - p) + b (v_meant - v) - c v + F, F held over a tick and
/// solved by short steps. No clock.
class SimulatedHand {
 public:
  /// @throws std::invalid_argument for a mass that is not > 0, or another value < 0.
  SimulatedHand(const HandSettings& settings, const Vec3& position);

  /// A tick of `dt` [s] with the hand meaning to be at `meant` [m], where it goes on with `meant_v`
  /// [m/s], while the device renders `force` and something else pushes with `push` [N].
  void tick(const Vec3& meant, const Vec3& meant_v, const Vec3& force, const Vec3& push, double dt);

  /// It is at `p` [m], whatever it feels, with `v` [m/s].
  void setState(const Vec3& p, const Vec3& v) {
    p_ = p;
    v_ = v;
  }

  const Vec3& position() const { return p_; }  ///< [m]
  const Vec3& velocity() const { return v_; }  ///< [m/s]
  /// As the device's encoders say it.
  Vec3 measured() const;

 private:
  HandSettings settings_;
  Vec3 p_, v_ = Vec3::Zero();
};

}  // namespace palpate::haptics
