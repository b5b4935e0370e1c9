// SPDX-License-Identifier: GPL-3.0-or-later
// Search for candidate triangles of tool balls.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "face_points.h"
#include "palpate/contact/signed_distance.h"

namespace palpate::contact {
namespace {

// Least area of a ball [m^2], which limits penetration on fine meshes.
constexpr double kLeastArea = 2e-5;

double meanEdge(const Mat3& corners) {
  return ((corners.col(1) - corners.col(0)).norm() + (corners.col(2) - corners.col(1)).norm() +
          (corners.col(0) - corners.col(2)).norm()) /
         3.0;
}

}  // namespace

// Fills found_ with pairs of ball and index in near_ that may be within reach, sorted by ball, then
// triangle. There may be a million after a jump of the tool.
void FacePoints::findPairs(const Shape& shape, double reach) {
  const auto forPairs = [&](const auto& visit) {
    for (std::size_t k = 0; k < near_.size(); ++k) {
      const Near& t = near_[k];
      // Balls in the slice of the shape within reach of the triangle.
      const double far = t.radius + reach + shape.largest;
      const double begin = t.middle_G[shape.axis] - far, end = t.middle_G[shape.axis] + far;
      auto ball = std::lower_bound(
          shape.balls.begin(), shape.balls.end(), begin,
          [&](const TouchBall& of, double at) { return of.center_G[shape.axis] < at; });
      for (; ball != shape.balls.end() && ball->center_G[shape.axis] <= end; ++ball) {
        if ((ball->center_G - t.middle_G).squaredNorm() > far * far) continue;
        visit(static_cast<std::size_t>(ball - shape.balls.begin()), k);
      }
    }
  };
  // Counting sort.
  places_.assign(shape.balls.size() + 1, 0);
  forPairs([&](std::size_t ball, std::size_t) { ++places_[ball + 1]; });
  std::partial_sum(places_.begin(), places_.end(), places_.begin());
  found_.resize(places_.back());
  forPairs([&](std::size_t ball, std::size_t k) {
    found_[places_[ball]++] = {static_cast<int>(ball), static_cast<int>(k)};
  });
}

void FacePoints::findCandidates(const Points& x, const std::vector<PosedObstacle>& posed, int b,
                                double reach) {
  const Shape& shape = *shapes_[b];
  if (shape.balls.empty()) return;
  const instrument::Geometry& geometry = *posed[b].obstacle().geometry;
  const double bounding = boundingRadius(geometry) + reach;
  near_.clear();
  for (Eigen::Index t = 0; t < triangles_.cols(); ++t) {
    const int triangle = static_cast<int>(t);
    const Mat3 at = corners(x, triangle);
    const Vec3 middle = at.rowwise().mean();
    const double radius = std::sqrt((at.colwise() - middle).colwise().squaredNorm().maxCoeff());
    const Vec3 middle_G = posed[b].toObstacle(middle);
    if (middle_G.norm() > bounding + radius) continue;
    if (signedDistanceValue(geometry, middle_G) > reach + radius) continue;
    near_.push_back({triangle, middle_G, radius, meanEdge(at)});
  }
  findPairs(shape, reach);
  const std::size_t first_group = groups_.size();
  found_at_ = x;
  double nearest = 0.0;
  for (const auto& [of_ball, place] : found_) {
    const int triangle = near_[static_cast<std::size_t>(place)].triangle;
    const TouchBall& ball = shape.balls[of_ball];
    const Vec3 center = posed[b].obstacle().X_WG_end * ball.center_G;
    const Mat3 at = corners(x, triangle);
    const TrianglePoint near = nearestOnTriangle(center, at.col(0), at.col(1), at.col(2));
    const double distance = (center - near.point).norm();
    if (!(distance <= reach + ball.radius)) continue;
    if (groups_.empty() || groups_.back().obstacle != b || groups_.back().ball != of_ball) {
      groups_.push_back({b, of_ball, numCandidates(), 0, 0.0, 0, 0.0, true, 0.0, center, triangle});
      nearest = std::numeric_limits<double>::infinity();
    }
    candidates_.push_back({triangle, near_[static_cast<std::size_t>(place)].edge, distance});
    char& used = is_used_[static_cast<std::size_t>(triangle)];
    if (!used) used_.push_back(triangle);
    used = 1;
    groups_.back().end = numCandidates();
    if (!(distance < nearest)) continue;
    nearest = distance;
    groups_.back().area = std::max(areas_[triangle] / 3.0, kLeastArea);
    groups_.back().first = groups_.back().nearest = triangle;
    groups_.back().edge = candidates_.back().edge;
  }
  by_distance_.resize(candidates_.size());
  forget();
  placeTriangles(x);
  for (std::size_t g = first_group; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    for (int c = group.begin; c < group.end; ++c) {
      by_distance_[c] = {candidates_[c].apart, c, candidates_[c].triangle};
    }
    order(group);
    group.apart = by_distance_[group.begin].apart;
    pairs_.clear();
    group.behind = pairs_[measure(x, posed, &group, 0.0).nearest].distance < 0.0;
  }
}

}  // namespace palpate::contact
