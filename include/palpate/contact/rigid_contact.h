// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/contact/touch_balls.h"
#include "palpate/instrument/geometry.h"

namespace palpate::contact {

/// Penetration of a moving rigid shape into a fixed one.
struct RigidTouch {
  Vec3 p_W;      ///< Point of the moving shape's surface, world [m].
  double depth;  ///< [m], > 0
  Vec3 force_W;  ///< Force on the moving shape, world [N].
};

/// Contact of a rigid tool with a fixed rigid shape, by one spring for all points together. The
/// spring's stretch D is a norm of the depths d_k, close to the largest:
///
///   E = stiffness / 2 D^2,   D = (sum_k d_k^m)^(1/m),   m = kDepthPower.
///
/// E depends on the tool's pose alone, so a closed path does no work. n equally deep points give
/// n^(2/m) times the stiffness of one; n springs would give n times. The force never pulls, and is
/// continuous where points begin and end to touch.
class RigidContact {
 public:
  /// `stiffness` [N/m].
  /// @pre `fixed` outlives this; the grid of a sampled surface reaches beyond it by a ball's
  /// radius.
  RigidContact(const instrument::Geometry* fixed, const Pose& X_WG, double stiffness);

  /// Reserves memory for this number of balls.
  void reserve(std::size_t balls) { touches_.reserve(balls); }
  /// Removes all touches.
  void clear();
  /// Adds a tool's shape at pose X_WT with its bounding radius about the origin [m]. Returns false
  /// where the bounding ball does not touch.
  bool add(const std::vector<TouchBall>& balls, double bounding_radius, const Pose& X_WT);
  /// Whether a shape at X_WT would touch.
  bool wouldTouch(const std::vector<TouchBall>& balls, double bounding_radius,
                  const Pose& X_WT) const;
  /// Computes the forces of all touches. Returns the energy [J].
  double solve();
  const std::vector<RigidTouch>& touches() const { return touches_; }

 private:
  bool mayTouch(double bounding_radius, const Vec3& origin_G) const;

  const instrument::Geometry* fixed_;
  Pose X_WG_, X_GW_;
  double stiffness_, error_;
  std::vector<RigidTouch> touches_;
};

constexpr int kDepthPower = 8;

}  // namespace palpate::contact
