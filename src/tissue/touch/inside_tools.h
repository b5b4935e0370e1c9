// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/obstacle.h"
#include "palpate/contact/touch_balls.h"

namespace palpate::tissue {

/// Instrument shapes inside a body that contact did not press in: they began deeper than a quarter
/// of the way to their middle, jumped in, or moved in while solves failed. They exert no force
/// until they are clear of the body, so none lifts the surface from within or is expelled.
/// @pre Obstacles with the same geometry pointer have the same geometry.
class InsideTools {
 public:
  /// Updates the set at a cycle's begin, for obstacles that may touch the surface at x, 3 x n [m].
  /// An obstacle is tested when it comes near, and in each cycle while it is inside.
  void update(const std::vector<contact::Obstacle>& near, const Points& x,
              const Eigen::Matrix3Xi& triangles);
  /// Obstacle::number of the inside tools, ascending.
  const std::vector<int>& inside() const { return inside_; }
  /// Marks all tools as unverified after a failed cycle; the next update() tests each.
  void invalidate() { unverified_.swap(outside_), outside_.clear(); }
  /// Clears the state.
  void forget() { outside_.clear(), unverified_.clear(), inside_.clear(); }

  void save(StateWriter* to) const;
  void restore(StateReader* from);

 private:
  const std::vector<contact::TouchBall>& ballsOf(const contact::Obstacle& obstacle);

  std::vector<int> outside_, inside_;  // numbers at the last update(), ascending
  std::vector<int> unverified_;        // outside before the failed cycle
  std::vector<int> next_outside_, next_inside_;
  std::map<const instrument::Geometry*, std::vector<contact::TouchBall>>
      balls_;  // cache of ballsOf()
};

}  // namespace palpate::tissue
