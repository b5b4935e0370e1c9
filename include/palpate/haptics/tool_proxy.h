// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/base/types.h"

namespace palpate::haptics {

/// How fast a tool may be moved by what commands it.
struct ProxySettings {
  double max_speed = 1.0;                  ///< Of the control frame's origin [m/s].
  double max_acceleration = 100.0;         ///< [m/s^2]
  double max_angular_speed = 15.0;         ///< Of the tool, and of links to one another [rad/s].
  double max_angular_acceleration = 1500;  ///< [rad/s^2]
};

/// The tool that tissue feels, between cycles of the simulation: it goes where it is commanded to,
/// but never by a jump. While the command stays within the limits the tool is where it is
/// commanded, bit for bit. A tool that is not there yet, or is there again after its input was
/// lost, comes when it is commanded to a pose where it touches nothing. No clock, no allocation
/// once it has been there: the caller says how long a cycle is.
class ToolProxy {
 public:
  using LinkPoses = std::vector<Pose>;  ///< X_WL of all links of the tool.
  using Free = std::function<bool(const LinkPoses&)>;

  /// `links`: those that can touch, which keep the limits to one another too.
  /// @throws std::invalid_argument if a limit is not finite and > 0.
  ToolProxy(const ProxySettings& settings, std::size_t control_link,
            std::vector<std::size_t> links);

  /// A cycle of `dt` [s] in which the tool is commanded to these poses; `is_free`: whether it would
  /// touch nothing there. Returns whether it is there.
  bool follow(const LinkPoses& commanded, double dt, const Free& is_free);
  /// No command: the tool is not there.
  void leave();
  /// It is there, at rest.
  void startAt(const LinkPoses& poses);

  bool there() const { return !poses_.empty(); }
  /// Commanded in vain: it would touch something.
  bool waiting() const { return waiting_; }
  /// Where it is; empty if it is not there.
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
