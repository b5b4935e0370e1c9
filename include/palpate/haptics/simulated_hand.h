// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::haptics {

/// Parameters of a simulated hand on a haptic device, for tests of the force loop.
struct HandSettings {
  double mass = 0.1;              ///< Apparent mass of device and hand [kg].
  double device_damping = 0.2;    ///< [N s/m]
  double grip_stiffness = 100.0;  ///< Stiffness between intended and present position [N/m].
  double grip_damping = 1.0;      ///< [N s/m]
  double resolution = 5.5e-5;     ///< Resolution of the measured position [m]; 0: exact.
  double guide_stiffness = 0.0;  ///< Additional grip stiffness across z, of a supported hand [N/m],
  double guide_damping = 0.0;    ///< [N s/m]
};

/// A mass on springs and dampers towards the intended position, under the rendered force F:
/// m a = k (p_meant - p) + b (v_meant - v) - c v + F.
/// F is constant over a tick. Reads no clock.
class SimulatedHand {
 public:
  /// @throws std::invalid_argument for a mass that is not > 0, or another value < 0.
  SimulatedHand(const HandSettings& settings, const Vec3& position);

  /// Simulates a tick of `dt` [s]. `meant` [m], `meant_v` [m/s]: intended motion; `force`: rendered
  /// force [N]; `push`: another external force [N].
  void tick(const Vec3& meant, const Vec3& meant_v, const Vec3& force, const Vec3& push, double dt);

  /// Sets position `p` [m] and velocity `v` [m/s].
  void setState(const Vec3& p, const Vec3& v) {
    p_ = p;
    v_ = v;
  }

  const Vec3& position() const { return p_; }  ///< [m]
  const Vec3& velocity() const { return v_; }  ///< [m/s]
  /// Position as the device's encoders measure it [m].
  Vec3 measured() const;

 private:
  HandSettings settings_;
  Vec3 p_, v_ = Vec3::Zero();
};

}  // namespace palpate::haptics
