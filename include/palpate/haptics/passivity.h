// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/base/types.h"

namespace palpate::haptics {

struct PassivitySettings {
  double max_damping = 2.0;           ///< What the controller may add [N s/m]; 0: it only observes.
  double velocity_smoothing = 0.004;  ///< Time constant of the velocity that it damps [s].
};

/// Watches the energy that goes through the wrench port of one instrument, and takes back what
/// comes out and never went in, by damping while the tool touches [Hannaford, Ryu 2002]. Energy
/// is that of what was sent, along what the device reports: sum f . dp. No clock.
class PassivityController {
 public:
  /// @throws std::invalid_argument if a setting is not finite and >= 0.
  explicit PassivityController(const PassivitySettings& settings = {});

  /// A tick of `dt` > 0 [s] begins with the device reporting `p` [m], after `sent` [N] was rendered
  /// until now; `force` is to be rendered next. Returns what to add to it [N].
  Vec3 update(const Vec3& p, const Vec3& sent, const Vec3& force, double dt);

  /// What came out since the tool last touched nothing, less what went in [J].
  double energyOut() const { return out_; }
  /// The most that came out unpaid, and what the controller took back, since construction [J].
  double largestOut() const { return largest_; }
  double dissipated() const { return dissipated_; }
  double damping() const { return damping_; }  ///< Of the last tick [N s/m].

 private:
  void observe(const Vec3& p, const Vec3& sent, double dt);

  PassivitySettings settings_;
  bool begun_ = false;
  Vec3 p_ = Vec3::Zero(), v_ = Vec3::Zero(), added_ = Vec3::Zero();
  Vec3 impulse_ = Vec3::Zero(), damping_impulse_ = Vec3::Zero();  // since the last motion [N s]
  double time_ = 0.0;                                             // likewise [s]
  double out_ = 0.0, largest_ = 0.0, dissipated_ = 0.0, damping_ = 0.0;
};

}  // namespace palpate::haptics
