// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/obstacle.h"

namespace palpate::tissue {

/// Distances of points from predicted tool poses, by the motion of the last cycle, and whether
/// tools have moved since suited().
class ToolDistance {
 public:
  /// `motion`: least displacement that counts [m], less for a resting tool, so that its final mesh
  /// does not depend on its path; `most_ahead`: largest predicted displacement [m].
  ToolDistance(double motion, double most_ahead) : motion_(motion), most_ahead_(most_ahead) {}

  /// Ends a cycle, and predicts poses `cycles` ahead. Returns false where no tool has moved since
  /// suited(), or, with `far` > 0, none is nearer than `far` [m] to the bounding box of x, 3 x n
  /// [m].
  /// `coarsening`: factor of the least displacement that counts [-].
  bool look(const std::vector<contact::Obstacle>& obstacles, double cycles, const Points& x,
            double far, double coarsening = 1.0);
  /// Least signed distance of p from a tool, world [m]; infinity without any.
  double distance(const Vec3& p) const;

  /// Marks the present tool poses as handled.
  void suited();
  void forget() { suited_.clear(); }

  /// Writes and reads the poses of suited().
  void save(StateWriter* out) const;
  void restore(StateReader* in);
  /// Writes and reads the present poses.
  /// @pre takeShapes() before distance().
  void saveTools(StateWriter* out) const;
  void restoreTools(StateReader* in);
  void takeShapes(const std::vector<contact::Obstacle>& obstacles);

 private:
  struct Tool {
    const instrument::Geometry* of;                        // of the obstacle
    std::shared_ptr<const instrument::Geometry> geometry;  // copy for background tasks
    Pose X_WG, X_GW;
  };
  std::vector<Pose> poses() const;

  Pose ahead(const contact::Obstacle& obstacle, double cycles) const;

  double motion_, most_ahead_;
  std::vector<Tool> tools_;
  std::vector<Pose> suited_;  // of all tools; empty: none
};

}  // namespace palpate::tissue
