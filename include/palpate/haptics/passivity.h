// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "palpate/base/types.h"

namespace palpate::haptics {

struct PassivitySettings {
  double max_damping = 2.0;  ///< What the controller may add [N s/m]; 0: it only observes.
};

/// Watches the energy that goes through the wrench port of one instrument, and takes back what
/// comes out and never went in, by damping while the tool touches [Hannaford, Ryu 2002]. Energy
/// is that of what was sent, along what the device reports: sum f . dp. What it reports now has
/// felt what was sent a delay ago. No clock.
class PassivityController {
 public:
  static constexpr double kLongestDelay = 0.1;  ///< A longer one counts as this [s].

  /// `delay`: from a force sent to the pose heard that has felt it [s].
  /// @throws std::invalid_argument if a setting or the delay is not finite and >= 0.
  explicit PassivityController(const PassivitySettings& settings = {}, double delay = 0.0);

  /// A tick of `dt` > 0 [s] begins with the device reporting `p` [m], where it goes with `v` [m/s],
  /// after `sent` [N] was sent until now; `force` is to be sent next. Returns what to add to it
  /// [N].
  Vec3 update(const Vec3& p, const Vec3& v, const Vec3& sent, const Vec3& force, double dt);

  /// The most that came out unpaid, and what the controller took back, since construction [J].
  double largestOut() const { return largest_; }
  double dissipated() const { return dissipated_; }
  double damping() const { return damping_; }  ///< Of the last tick [N s/m].

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
