// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/base/types.h"

namespace palpate::haptics {

/// Motion limits of a tool proxy.
struct ProxySettings {
  double max_speed = 1.0;                  ///< Speed of the control frame's origin [m/s].
  double max_acceleration = 100.0;         ///< [m/s^2]
  double max_angular_speed = 15.0;         ///< Of the tool, and between links [rad/s].
  double max_angular_acceleration = 1500;  ///< [rad/s^2]
};

/// Pose of a tool in the simulation: follows the commanded pose within limits of speed and
/// acceleration, and equals it bitwise within these. A tool appears, at first or after a loss of
/// its input, only at a commanded pose where it touches nothing. Reads no clock; allocates only
/// when it first appears.
class ToolProxy {
 public:
  using LinkPoses = std::vector<Pose>;  ///< X_WL of all links of the tool.
  using Free = std::function<bool(const LinkPoses&)>;

  /// `links`: links with collision shapes; relative motion of these is limited too.
  /// @throws std::invalid_argument if a limit is not finite and > 0.
  ToolProxy(const ProxySettings& settings, std::size_t control_link,
            std::vector<std::size_t> links);

  /// Simulates a cycle of `dt` [s] with commanded poses; `is_free`: whether poses touch nothing.
  /// Returns whether the tool is present.
  bool follow(const LinkPoses& commanded, double dt, const Free& is_free);
  /// Removes the tool: no command.
  void leave();
  /// Puts the tool at these poses, at rest.
  void startAt(const LinkPoses& poses);

  bool there() const { return !poses_.empty(); }
  /// Whether a commanded tool is absent because it would touch something.
  bool waiting() const { return waiting_; }
  /// Poses of the links; empty while the tool is absent.
  const LinkPoses& poses() const { return poses_; }

  void save(StateWriter* out) const;
  void restore(StateReader* in);

 private:
  void approach(const LinkPoses& commanded, double dt);

  ProxySettings settings_;
  std::size_t control_;
  std::vector<std::size_t> links_;
  LinkPoses poses_, next_;
  Vec3 velocity_ = Vec3::Zero(), angular_velocity_ = Vec3::Zero();  // of the control frame
  bool waiting_ = false;
};

}  // namespace palpate::haptics
