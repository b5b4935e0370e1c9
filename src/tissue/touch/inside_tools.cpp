// SPDX-License-Identifier: GPL-3.0-or-later
#include "inside_tools.h"

#include <algorithm>

#include "palpate/contact/overlap.h"
#include "palpate/contact/signed_distance.h"
#include "sweep.h"

namespace palpate::tissue {
namespace {

// Largest depth at which a new shape is pressed out, relative to the way to its middle [-].
constexpr double kMaxStartDepth = 0.25;
constexpr double kMaxPressedDepth = 0.9;  // the same for a shape that was outside before [-]

bool holds(const std::vector<int>& numbers, int number) {
  return std::binary_search(numbers.begin(), numbers.end(), number);
}

// Whether the obstacle moves farther in a cycle than the tissue can follow.
bool leaps(const contact::Obstacle& obstacle) {
  const double way =
      contact::sweepLength(*obstacle.geometry, obstacle.X_WG_begin, obstacle.X_WG_end);
  return way > 0.5 * kMaxSweepStages * contact::inscribedRadius(*obstacle.geometry);
}

}  // namespace

void InsideTools::update(const std::vector<contact::Obstacle>& near, const Points& x,
                         const Eigen::Matrix3Xi& triangles) {
  next_outside_.clear();
  next_inside_.clear();
  for (const contact::Obstacle& obstacle : near) {
    if (!obstacle.owner.isInstrument()) continue;
    bool in = false;
    if (holds(inside_, obstacle.number)) {
      in = contact::overlaps(*obstacle.geometry, obstacle.X_WG_begin, x, triangles);
    } else if (!holds(outside_, obstacle.number)) {
      const double most = holds(unverified_, obstacle.number) ? kMaxPressedDepth : kMaxStartDepth;
      in = contact::hasSunkIn(*obstacle.geometry, ballsOf(obstacle), obstacle.X_WG_begin, x,
                              triangles, most);
    }
    if (in) {
      next_inside_.push_back(obstacle.number);
    } else if (!leaps(obstacle)) {
      next_outside_.push_back(obstacle.number);
    }
  }
  unverified_.clear();
  outside_.swap(next_outside_);
  inside_.swap(next_inside_);
}

const std::vector<contact::TouchBall>& InsideTools::ballsOf(const contact::Obstacle& obstacle) {
  std::vector<contact::TouchBall>& balls = balls_[obstacle.geometry];
  if (balls.empty()) balls = contact::sunkBalls(*obstacle.geometry);
  return balls;
}

void InsideTools::save(StateWriter* to) const {
  to->put(outside_);
  to->put(unverified_);
  to->put(inside_);
}

void InsideTools::restore(StateReader* from) {
  from->get(&outside_);
  from->get(&unverified_);
  from->get(&inside_);
}

}  // namespace palpate::tissue
