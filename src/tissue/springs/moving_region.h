// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/base/types.h"

namespace palpate::tissue {

/// The points that go on in a step: all, or, as in a published step of tetrahedra's springs, those
/// around what tools touch [CN 103400023 B, step 4]; the others stay where they are.
class MovingRegion {
 public:
  /// `X`: points at rest, 3 x n [m]. `radius` [m]: how far from a touched point; infinity: all
  /// points, always. `a`, `b`: the ends of each spring.
  MovingRegion(const Points& X, double radius, std::vector<int> a, std::vector<int> b);

  /// Points that move, ascending, and springs with an end that does.
  const std::vector<int>& points() const { return points_; }
  const std::vector<int>& springs() const { return springs_; }
  bool moves(int point) const { return moves_[static_cast<std::size_t>(point)] != 0; }
  /// Whether it is all points.
  bool whole() const { return points_.size() == moves_.size(); }

  /// The points near these move, too, from now on.
  void addAround(const std::vector<int>& touched);
  /// All go on, or none, as long as nothing is touched: what was set from outside is to settle.
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
