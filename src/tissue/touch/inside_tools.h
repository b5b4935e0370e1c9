// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/obstacle.h"
#include "palpate/contact/touch_balls.h"

namespace palpate::tissue {

/// Which instruments' shapes are inside a body though they were not pushed in: those that began
/// there, a quarter of the way to their middle or deeper, or got there by a leap or while nothing
/// could be solved. They exert no force until they are clear of it, so that none lifts the surface
/// from within, or is thrown out. A geometry stays as it is as long as obstacles have it.
class InsideTools {
 public:
  /// Looks where the obstacles are that may touch in a cycle that begins, with the surface at x,
  /// 3 x n [m]. One is asked again when it comes near anew, and as long as it is inside.
  void update(const std::vector<contact::Obstacle>& near, const Points& x,
              const Eigen::Matrix3Xi& triangles);
  /// Obstacle::number of each, ascending.
  const std::vector<int>& inside() const { return inside_; }
  /// Nothing is known of any: a cycle failed.
  void invalidate() { unverified_.swap(outside_), outside_.clear(); }
  /// As new: none is anywhere.
  void forget() { outside_.clear(), unverified_.clear(), inside_.clear(); }

  void save(StateWriter* to) const;
  void restore(StateReader* from);

 private:
  const std::vector<contact::TouchBall>& ballsOf(const contact::Obstacle& obstacle);

  std::vector<int> outside_, inside_;  // numbers, ascending; as of the last update()
  std::vector<int> unverified_;        // that were outside before a cycle failed
  std::vector<int> next_outside_, next_inside_;
  std::map<const instrument::Geometry*, std::vector<contact::TouchBall>> balls_;  // once asked
};

}  // namespace palpate::tissue
