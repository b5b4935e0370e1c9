// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "palpate/base/types.h"

namespace palpate::haptics {

struct PassivitySettings {
  double max_damping = 2.0;  ///< Largest added damping [N s/m]; 0: observer only.
};

/// Passivity observer and controller of one instrument: damping dissipates energy that the port has
/// generated, while the tool touches [Hannaford, Ryu 2002]. The energy is sum f . dp of forces sent
/// one delay ago and positions reported now. Reads no clock.
class PassivityController {
 public:
  static constexpr double kLongestDelay = 0.1;  ///< Upper bound of the delay [s].

  /// `delay`: from a sent force to the first reported pose under that force [s].
  /// @throws std::invalid_argument if a setting or the delay is not finite and >= 0.
  explicit PassivityController(const PassivitySettings& settings = {}, double delay = 0.0);

  /// Computes a tick of `dt` > 0 [s]. `p` [m], `v` [m/s]: reported motion; `sent`: last force [N];
  /// `force`: next force [N]. Returns the damping force to add [N].
  Vec3 update(const Vec3& p, const Vec3& v, const Vec3& sent, const Vec3& force, double dt);

  /// Largest generated energy, and energy dissipated by the controller, since construction [J].
  double largestOut() const { return largest_; }
  double dissipated() const { return dissipated_; }
  double damping() const { return damping_; }  ///< Damping of the last tick [N s/m].

 private:
  struct Sent {
    Vec3 force = Vec3::Zero(), added = Vec3::Zero();
    double dt = 0.0;
  };
  const Sent& delayed(const Sent& now);
  void observe(const Vec3& p, const Sent& sent);

  PassivitySettings settings_;
  double delay_;
  bool begun_ = false;
  std::array<Sent, 128> under_way_;    // a ring, newest at `newest_`
  std::size_t newest_ = 0, felt_ = 0;  // what is felt now
  double age_ = 0.0;                   // of what is felt [s]
  Vec3 p_ = Vec3::Zero(), added_ = Vec3::Zero();
  Vec3 impulse_ = Vec3::Zero(), damping_impulse_ = Vec3::Zero();  // since the last motion [N s]
  double time_ = 0.0;                                             // likewise [s]
  double out_ = 0.0, largest_ = 0.0, dissipated_ = 0.0, damping_ = 0.0;
};

}  // namespace palpate::haptics
