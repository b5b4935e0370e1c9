// SPDX-License-Identifier: GPL-3.0-or-later
// How far a tool's balls are from the triangles that they may touch.
#include <algorithm>
#include <cmath>

#include "face_points.h"

namespace palpate::contact {
namespace {

// Nearer than that to an edge or a corner a ball's centre has no direction from there [m].
constexpr double kNoDirection = 1e-12;

}  // namespace

// What was measured elsewhere is no more known.
void FacePoints::measureAt(const Points& x, const std::vector<PlacedObstacle>& placed) const {
  if (groups_.empty()) return;
  if (measured_anywhere_ && measured_at_.cols() == x.cols() && measured_at_ == x) return;
  measured_anywhere_ = true;
  measured_at_ = x;
  placeTriangles(x);
  if (disordered(placed)) orderAgain(x, placed);
  meetings_.clear();
  measured_.assign(groups_.size(), {-1.0, 0, 0, 0});
}

const FacePoints::Measured& FacePoints::measured(const Points& x,
                                                 const std::vector<PlacedObstacle>& placed,
                                                 std::size_t group, double within) const {
  Measured& known = measured_[group];
  if (known.within < within) known = measure(x, placed, groups_[group], within);
  return known;
}

// Adds the triangles that may be the nearest or are nearer than `within` to meetings_. Of those
// that are equally near, as those around an edge or a corner are, the one that the centre is most
// in front of, or behind, knows the side.
FacePoints::Measured FacePoints::measure(const Points& x, const std::vector<PlacedObstacle>& placed,
                                         const Group& group, double within) const {
  const Vec3 center = centerOf(placed, group);
  findNear(x, center, group, within);
  const std::size_t begin = meetings_.size();
  std::size_t nearest = begin;
  double most_across = 0.0;
  for (const std::pair<int, double>& close : close_) {
    const int c = close.first;
    const int triangle = candidates_[c].triangle;
    const Mat3 at = corners(x, triangle);
    const Vec3 n = normals_.col(triangle);
    Meeting m{};
    m.near = nearestOnTriangle(center, at.col(0), at.col(1), at.col(2));
    const Vec3 way = center - m.near.point;
    m.distance = way.norm();
    m.direction = m.distance > kNoDirection ? Vec3(way / m.distance) : n;
    double across = n.dot(way);
    if (m.near.feature == Feature::kFace) {  // exact however near
      m.direction = across < 0.0 ? Vec3(-n) : n;
      m.distance = std::abs(across);
    }
    m.edge = candidates_[c].edge;
    m.triangle = triangle;
    m.first = group.first;
    meetings_.push_back(m);
    const double least = meetings_[nearest].distance;
    const bool as_near = m.distance <= least * (1.0 + 1e-9) + kNoDirection;
    if (meetings_.size() == begin + 1 || m.distance < least * (1.0 - 1e-9) - kNoDirection ||
        (as_near && std::abs(across) > std::abs(most_across))) {
      nearest = meetings_.size() - 1;
      most_across = across;
    }
  }
  Meeting& m = meetings_[nearest];
  // Where the surface crosses itself, the nearest triangle may be another one at once. A ball that
  // was in front gets behind by kFollow at a time, not by an edge, or its diameter.
  const bool crossed = !group.behind && m.distance > std::max(group.edge, 2.0 * ball(group).radius);
  const bool behind = most_across < 0.0 && !crossed;
  for (std::size_t k = begin; k < meetings_.size(); ++k) meetings_[k].touched = !behind;
  m.touched = true;
  if (behind) {
    m.distance = -m.distance;
    m.direction = -m.direction;
  }
  return {within, begin, meetings_.size(), nearest};
}

}  // namespace palpate::contact
