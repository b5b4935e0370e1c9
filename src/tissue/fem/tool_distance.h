// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/obstacle.h"

namespace palpate::tissue {

/// How far points are from the tools where these will be if they go on as in the last cycle, and
/// whether they have moved since it last mattered.
class ToolDistance {
 public:
  /// `motion` [m]: a tool of which no point has gone farther has not moved; of one that rests less
  /// counts, so that it ends up with the same wherever it came from. `most_ahead` [m]: so
  /// far a tool is taken to go on at most.
  ToolDistance(double motion, double most_ahead) : motion_(motion), most_ahead_(most_ahead) {}

  /// Ends a cycle: tools go on for `cycles` more. False: since suited() none has moved, or, if
  /// `far` > 0, none is nearer than `far` [m] to the box around x, 3 x n [m].
  bool look(const std::vector<contact::Obstacle>& obstacles, double cycles, const Points& x,
            double far);
  /// The least signed distance of p from a tool [m]; infinity without any.
  double distance(const Vec3& p) const;

  /// What depends on the tools is right where they are now.
  void suited();
  void forget() { suited_.clear(); }

  /// Where the tools were when it last mattered, and back to it.
  void save(StateWriter* out) const;
  void restore(StateReader* in);
  /// Where the tools are, and back to it; takeShapes() next, before distance() is asked.
  void saveTools(StateWriter* out) const;
  void restoreTools(StateReader* in);
  void takeShapes(const std::vector<contact::Obstacle>& obstacles);

 private:
  struct Tool {
    const instrument::Geometry* of;                        // the obstacle's,
    std::shared_ptr<const instrument::Geometry> geometry;  // and a copy, for work beside the cycle
    Pose X_WG, X_GW;
  };
  std::vector<Pose> poses() const;

  Pose ahead(const contact::Obstacle& obstacle, double cycles) const;

  double motion_, most_ahead_;
  std::vector<Tool> tools_;
  std::vector<Pose> suited_;  // of all tools; empty: nothing is known
};

}  // namespace palpate::tissue
