// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/base/types.h"

namespace palpate::tissue {

/// Points that move in a step: all, or those around touched points, as published for springs of
/// tetrahedra [CN 103400023 B, step 4]; others are fixed.
class MovingRegion {
 public:
  /// `X`: rest positions, 3 x n [m]; `radius`: around touched points [m], infinity: all; `a`, `b`:
  /// ends of each spring.
  MovingRegion(const Points& X, double radius, std::vector<int> a, std::vector<int> b);

  /// Moving points, ascending, and springs with a moving end.
  const std::vector<int>& points() const { return points_; }
  const std::vector<int>& springs() const { return springs_; }
  bool moves(int point) const { return moves_[static_cast<std::size_t>(point)] != 0; }
  /// Whether the region has all points.
  bool whole() const { return points_.size() == moves_.size(); }

  /// Adds the points near these to the region.
  void addAround(const std::vector<int>& touched);
  /// Makes all points, or none, move until a touch; all after positions were set, to reach
  /// equilibrium.
  void setAll();
  void clear();

  void save(StateWriter* out) const;
  void restore(StateReader* in);

 private:
  void list();

  Points X_;
  double radius_;
  std::vector<int> a_, b_;
  std::vector<char> moves_, centres_;  // n
  std::vector<int> points_, springs_;
};

}  // namespace palpate::tissue
