// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/touch.h"

namespace palpate::contact {

/// Whether teeth hold a touch: not yet, or they do, or they did and it was torn off, until it ends.
enum class Bite : int { kNone, kHeld, kTorn };

/// Where a touch clings to its obstacle: a spring's stretch from there to the sample.
struct StickPoint {
  int number = 0, sample = 0;  ///< Obstacle::number, Touch::sample.
  double pressing = 0.0;       ///< The normal force where the step ended [N],
  double rise = 0.0;           ///< and how it rose in the step [N].
  bool slides = false;         ///< It slipped when the step ended.
  Bite bite = Bite::kNone;
  Vec3 stretch_G = Vec3::Zero();  ///< In the obstacle's frame [m].

  bool before(const StickPoint& other) const {
    return number != other.number ? number < other.number : sample < other.sample;
  }
};

/// The points of all touches where a step ended, sorted.
class StickPoints {
 public:
  /// Null: it did not touch.
  const StickPoint* find(const Touch& touch) const;
  /// Whether teeth hold one of the samples [first, last] of an obstacle.
  bool hold(int number, int first, int last) const;
  bool empty() const { return points_.empty(); }

  /// Takes the place of those before.
  void take(const std::vector<StickPoint>& points);
  void clear() { points_.clear(); }
  /// Takes over those of another surface, `now(i)` being sample i in this one, or -1.
  void goOnFrom(const StickPoints& old, const std::function<int(int)>& now);
  void save(StateWriter* to) const;
  /// @throws std::invalid_argument as StateReader does; the points are then as they were.
  void restore(StateReader* from);

 private:
  std::vector<StickPoint> points_;
};

}  // namespace palpate::contact
