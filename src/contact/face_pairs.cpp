// SPDX-License-Identifier: GPL-3.0-or-later
// Distances of tool balls from candidate triangles.
#include <algorithm>
#include <cmath>

#include "face_points.h"

namespace palpate::contact {
namespace {

// Distance from an edge or corner below which the direction is undefined [m].
constexpr double kCoincident = 1e-12;

}  // namespace

// Clears the cache where x has changed.
void FacePoints::measureAt(const Points& x) const {
  if (groups_.empty()) return;
  if (measured_anywhere_ && measured_at_.cols() == x.cols() && measured_at_ == x) return;
  measured_anywhere_ = true;
  measured_at_ = x;
  placeTriangles(x);
  pairs_.clear();
  measured_.assign(groups_.size(), {-1.0, 0, 0, 0});
}

const FacePoints::Measured& FacePoints::measured(const Points& x,
                                                 const std::vector<PosedObstacle>& posed,
                                                 std::size_t group, double within) const {
  Measured& known = measured_[group];
  if (known.within < within) known = measure(x, posed, &groups_[group], within);
  return known;
}

// Measures a ball and a triangle as if in front; `across`: signed distance from the plane [m].
FacePoints::BallTrianglePair FacePoints::measurePair(const Vec3& center, const Mat3& corners,
                                                     int candidate, double* across) const {
  BallTrianglePair m{};
  m.triangle = candidates_[candidate].triangle;
  m.edge = candidates_[candidate].edge;
  m.near = nearestOnTriangle(center, corners.col(0), corners.col(1), corners.col(2));
  const Vec3 way = center - m.near.point, n = normals_.col(m.triangle);
  m.distance = way.norm();
  m.direction = m.distance > kCoincident ? Vec3(way / m.distance) : n;
  *across = n.dot(way);
  if (m.near.feature == Feature::kFace) {  // exact however near
    m.direction = *across < 0.0 ? Vec3(-n) : n;
    m.distance = std::abs(*across);
  }
  return m;
}

// Adds the nearest triangle and all nearer than `within` [m] to pairs_. Of equally near ones,
// around an edge or corner, the one with the largest plane distance decides the side.
FacePoints::Measured FacePoints::measure(const Points& x, const std::vector<PosedObstacle>& posed,
                                         Group* of, double within) const {
  const Group& group = *of;
  const Vec3 center = centerOf(posed, group);
  findNear(x, center, group, within);
  const std::size_t begin = pairs_.size();
  std::size_t nearest = begin;
  double most_across = 0.0;
  for (const std::pair<int, double>& close : close_) {
    const int c = close.first;
    double across = 0.0;
    BallTrianglePair m = measurePair(center, corners(x, candidates_[c].triangle), c, &across);
    m.first = group.first;
    pairs_.push_back(m);
    const double least = pairs_[nearest].distance;
    const bool as_near = m.distance <= least * (1.0 + 1e-9) + kCoincident;
    if (pairs_.size() == begin + 1 || m.distance < least * (1.0 - 1e-9) - kCoincident ||
        (as_near && std::abs(across) > std::abs(most_across))) {
      nearest = pairs_.size() - 1;
      most_across = across;
    }
  }
  BallTrianglePair& m = pairs_[nearest];
  of->nearest = m.triangle;
  // In self-intersections the nearest triangle may jump. A ball in front passes a triangle by at
  // most kFollow per step, not by an edge or its diameter.
  const bool crossed = !group.behind && m.distance > std::max(group.edge, 2.0 * ball(group).radius);
  const bool behind = most_across < 0.0 && !crossed;
  for (std::size_t k = begin; k < pairs_.size(); ++k) pairs_[k].touched = !behind;
  m.touched = true;
  if (behind) {
    m.distance = -m.distance;
    m.direction = -m.direction;
  }
  return {within, begin, pairs_.size(), nearest};
}

// Most steps are short against the distances of balls and triangles: a bound by the longest
// displacement skips those pairs.
double FacePoints::maxStep(const Points& x, const Points& d,
                           const std::vector<PosedObstacle>& posed, double largest) const {
  measureAt(x);
  double longest = 0.0;
  for (const int t : used_) {
    ways_[t] = std::sqrt(corners(d, t).colwise().squaredNorm().maxCoeff());
    longest = std::max(longest, ways_[t]);
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Group& group = groups_[g];
    if (staysAway(posed, group, longest * largest)) continue;
    const BallTrianglePair& nearest = pairs_[measured(x, posed, g, 0.0).nearest];
    const Vec3 center = centerOf(posed, group);
    for (int c = group.begin; c < group.end; ++c) {
      const auto [triangle, edge, apart] = candidates_[c];
      const double way = ways_[triangle] * largest, follow = kFollow * edge;
      const bool is_nearest = triangle == nearest.triangle;
      if (way <= follow) continue;
      const double reach = withSlack(way) - follow;
      const bool may_be_far = skip_far_ && !is_nearest;
      if (may_be_far && leastDistance(center, triangle, reach) >= reach) continue;
      double across = 0.0;
      const BallTrianglePair m =
          is_nearest ? nearest : measurePair(center, corners(x, triangle), c, &across);
      const double allowed = std::max(m.distance, 0.0) + follow;
      if (way <= allowed) continue;
      const double approach = m.direction.dot(corners(d, triangle) * m.near.weights);
      if (approach * largest > allowed) largest = allowed / approach;
    }
  }
  return largest;
}

}  // namespace palpate::contact
