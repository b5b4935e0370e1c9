// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/touch.h"

namespace palpate::contact {

/// Hold of a touch in all directions: none, held, or torn off until the touch ends.
enum class Hold : int { kNone, kHeld, kTorn };

/// Stick point of a touch: stretch of the friction spring from there to the sample.
struct StickPoint {
  int number = 0, sample = 0;  ///< Obstacle::number, Touch::sample.
  double pressing = 0.0;       ///< Normal force at the step's end [N].
  double rise = 0.0;           ///< Increase of the normal force in the step [N].
  bool slides = false;         ///< Whether the touch slipped at the step's end.
  Hold hold = Hold::kNone;
  Vec3 stretch_G = Vec3::Zero();  ///< Stretch in the obstacle's frame [m].

  bool before(const StickPoint& other) const {
    return number != other.number ? number < other.number : sample < other.sample;
  }
};

/// Stick points of all touches at the end of a step, sorted by obstacle and sample.
class StickPoints {
 public:
  /// Returns the stick point of a touch; null: none.
  const StickPoint* find(const Touch& touch) const;
  /// Whether an obstacle holds a sample in [first, last].
  bool hold(int number, int first, int last) const;
  bool empty() const { return points_.empty(); }

  /// Replaces all stick points.
  void take(const std::vector<StickPoint>& points);
  void clear() { points_.clear(); }
  /// Takes over the stick points of another surface; `now(i)`: present index of its sample i, or
  /// -1.
  void goOnFrom(const StickPoints& old, const std::function<int(int)>& now);
  void save(StateWriter* to) const;
  /// @throws std::invalid_argument as StateReader; the stick points are then unchanged.
  void restore(StateReader* from);

 private:
  std::vector<StickPoint> points_;
};

}  // namespace palpate::contact
