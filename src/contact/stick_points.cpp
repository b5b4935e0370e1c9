// SPDX-License-Identifier: GPL-3.0-or-later
#include "stick_points.h"

#include <algorithm>

namespace palpate::contact {
namespace {

bool stickPointBefore(const StickPoint& a, const StickPoint& b) { return a.before(b); }

}  // namespace

const StickPoint* StickPoints::find(const Touch& touch) const {
  StickPoint key;
  key.number = touch.number;
  key.sample = touch.sample;
  const auto found = std::lower_bound(points_.begin(), points_.end(), key, stickPointBefore);
  return found != points_.end() && !key.before(*found) ? &*found : nullptr;
}

bool StickPoints::hold(int number, int first, int last) const {
  StickPoint key;
  key.number = number;
  key.sample = first;
  for (auto point = std::lower_bound(points_.begin(), points_.end(), key, stickPointBefore);
       point != points_.end() && point->number == number && point->sample <= last; ++point) {
    if (point->hold == Hold::kHeld) return true;
  }
  return false;
}

void StickPoints::take(const std::vector<StickPoint>& points) {
  points_.assign(points.begin(), points.end());  // into the same memory
  std::sort(points_.begin(), points_.end(), stickPointBefore);
}

// Samples < 0 are balls of the obstacle, which keep their index.
void StickPoints::goOnFrom(const StickPoints& old, const std::function<int(int)>& now) {
  points_.clear();
  for (StickPoint point : old.points_) {
    if (point.sample >= 0) {
      point.sample = now(point.sample);
      if (point.sample < 0) continue;
    }
    points_.push_back(point);
  }
  std::sort(points_.begin(), points_.end(), stickPointBefore);
}

void StickPoints::save(StateWriter* to) const {
  to->put(static_cast<std::int64_t>(points_.size()));
  for (const StickPoint& point : points_) {
    to->put(point.number);
    to->put(point.sample);
    to->put(point.pressing);
    to->put(point.rise);
    to->put(point.slides);
    to->put(point.hold);
    for (int k = 0; k < 3; ++k) to->put(point.stretch_G[k]);
  }
}

void StickPoints::restore(StateReader* from) {
  std::vector<StickPoint> points(
      static_cast<std::size_t>(from->count(2 * sizeof(int) + 3 * sizeof(double))));
  for (StickPoint& point : points) {
    from->get(&point.number);
    from->get(&point.sample);
    from->get(&point.pressing);
    from->get(&point.rise);
    from->get(&point.slides);
    from->get(&point.hold);
    for (int k = 0; k < 3; ++k) from->get(&point.stretch_G[k]);
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!points[i - 1].before(points[i])) StateReader::fail();
  }
  points_.swap(points);
}

}  // namespace palpate::contact
