// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/contact/touch_balls.h"
#include "palpate/instrument/geometry.h"

namespace palpate::contact {

/// Where something rigid that moves is in something rigid that does not.
struct RigidTouch {
  Vec3 p_W;      ///< The point of the moving one's surface [m].
  double depth;  ///< [m], > 0
  Vec3 force_W;  ///< On the moving one [N].
};

/// Contact of a rigid tool with something rigid and fixed, by one spring for all of its touching
/// points together, whose stretch is a norm of their depths d_k, as large as the deepest or a
/// little larger:
///
///   E = stiffness / 2 D^2,   D = (sum_k d_k^m)^(1/m),   m = kDepthPower.
///
/// It is a function of the tool's pose alone: on a closed way it does no work. A single ball gives
/// stiffness times depth; n points that are equally deep give n^(2/m) times as stiff a contact,
/// while n springs would give n times. Points come and go without a jump of the force, which is
/// never one that pulls.
class RigidContact {
 public:
  /// `fixed` outlives this; if it is a sampled surface, its grid reaches as far beyond it as balls
  /// have a radius. `stiffness` [N/m].
  RigidContact(const instrument::Geometry* fixed, const Pose& X_WG, double stiffness);

  /// For so many balls at once nothing more is allocated.
  void reserve(std::size_t balls) { touches_.reserve(balls); }
  /// No tool touches.
  void clear();
  /// Adds the shape of a tool, with its frame at X_WT and the radius of a ball about its origin
  /// that holds it [m]. False: it is too far to touch, nothing more was looked at.
  bool add(const std::vector<TouchBall>& balls, double bounding_radius, const Pose& X_WT);
  /// Whether such a shape would touch.
  bool wouldTouch(const std::vector<TouchBall>& balls, double bounding_radius,
                  const Pose& X_WT) const;
  /// Finds the forces of all that was added, and returns the energy [J].
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
