// SPDX-License-Identifier: GPL-3.0-or-later
// Which triangles a tool's balls may touch, and which of these are looked at.
#include <algorithm>
#include <cmath>
#include <limits>

#include "face_points.h"
#include "palpate/contact/signed_distance.h"

namespace palpate::contact {
namespace {

// More than what counts as equally near: of a distance, and [m].
constexpr double kSlack = 1e-8, kLeastSlack = 1e-12;

// More triangles than so many are worth asking how far one of them is, not only its middle.
constexpr std::size_t kFew = 4;

// That a ball stands for [m^2]: on a fine mesh, too, it does not sink in.
constexpr double kLeastArea = 2e-5;

double withSlack(double distance) { return distance * (1.0 + kSlack) + kLeastSlack; }

Vec3 normalOf(const Mat3& corners) {
  return (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).normalized();
}

double meanEdge(const Mat3& corners) {
  return ((corners.col(1) - corners.col(0)).norm() + (corners.col(2) - corners.col(1)).norm() +
          (corners.col(0) - corners.col(2)).norm()) /
         3.0;
}

}  // namespace

void FacePoints::findCandidates(const Points& x, const std::vector<PlacedObstacle>& placed, int b,
                                double reach) {
  const Shape& shape = *shapes_[b];
  if (shape.balls.empty()) return;
  const instrument::Geometry& geometry = *placed[b].obstacle().geometry;
  const double bounding = boundingRadius(geometry) + reach;
  near_.clear();
  for (Eigen::Index t = 0; t < triangles_.cols(); ++t) {
    const int triangle = static_cast<int>(t);
    const Mat3 at = corners(x, triangle);
    const Vec3 middle = at.rowwise().mean();
    const double radius = std::sqrt((at.colwise() - middle).colwise().squaredNorm().maxCoeff());
    const Vec3 middle_G = placed[b].toObstacle(middle);
    if (middle_G.norm() > bounding + radius) continue;
    if (signedDistanceValue(geometry, middle_G) > reach + radius) continue;
    near_.push_back({triangle, middle_G, radius});
  }
  found_.clear();
  for (const Near& t : near_) {
    // The balls in the slice of the shape that the triangle may touch.
    const double far = t.radius + reach + shape.largest;
    const double begin = t.middle_G[shape.axis] - far, end = t.middle_G[shape.axis] + far;
    auto ball = std::lower_bound(
        shape.balls.begin(), shape.balls.end(), begin,
        [&](const TouchBall& of, double at) { return of.center_G[shape.axis] < at; });
    for (; ball != shape.balls.end() && ball->center_G[shape.axis] <= end; ++ball) {
      if ((ball->center_G - t.middle_G).squaredNorm() > far * far) continue;
      found_.emplace_back(static_cast<int>(ball - shape.balls.begin()), t.triangle);
    }
  }
  std::sort(found_.begin(), found_.end());
  const std::size_t first_group = groups_.size();
  found_at_ = x;
  double nearest = 0.0;
  for (const auto& [of_ball, triangle] : found_) {
    const TouchBall& ball = shape.balls[of_ball];
    const Vec3 center = placed[b].obstacle().X_WG_end * ball.center_G;
    const Mat3 at = corners(x, triangle);
    const TrianglePoint near = nearestOnTriangle(center, at.col(0), at.col(1), at.col(2));
    const double distance = (center - near.point).norm();
    if (!(distance <= reach + ball.radius)) continue;
    if (groups_.empty() || groups_.back().obstacle != b || groups_.back().ball != of_ball) {
      groups_.push_back({b, of_ball, numCandidates(), 0, 0.0, 0, 0.0, center, true});
      nearest = std::numeric_limits<double>::infinity();
    }
    candidates_.push_back({triangle, meanEdge(at), distance});
    char& used = is_used_[static_cast<std::size_t>(triangle)];
    if (!used) used_.push_back(triangle);
    used = 1;
    groups_.back().end = numCandidates();
    if (!(distance < nearest)) continue;
    nearest = distance;
    groups_.back().area = std::max(areas_[triangle] / 3.0, kLeastArea);
    groups_.back().first = triangle;
    groups_.back().edge = candidates_.back().edge;
  }
  orderCandidates(x, placed, first_group);
}

void FacePoints::orderCandidates(const Points& x, const std::vector<PlacedObstacle>& placed,
                                 std::size_t first_group) {
  forget();
  placeTriangles(x);
  for (std::size_t g = first_group; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    for (int c = group.begin; c < group.end; ++c) {
      by_distance_.push_back({candidates_[c].apart, c, candidates_[c].triangle});
    }
    std::sort(by_distance_.begin() + group.begin, by_distance_.end(),
              [](const Ordered& a, const Ordered& b) { return a.apart < b.apart; });
    meetings_.clear();
    const std::size_t nearest = measure(x, placed, group, 0.0).nearest;
    group.behind = meetings_[nearest].distance < 0.0;
  }
}

void FacePoints::placeTriangles(const Points& x) const {
  double farthest = 0.0;
  for (const int t : used_) {
    const Mat3 at = corners(x, t);
    const Mat3 way = at - corners(found_at_, t);
    farthest = std::max(farthest, way.colwise().squaredNorm().maxCoeff());
    const Vec3 middle = at.rowwise().mean();
    around_.col(t) << middle, std::sqrt((at.colwise() - middle).colwise().squaredNorm().maxCoeff());
    normals_.col(t) = normalOf(at);
  }
  moved_ = std::sqrt(farthest);
}

// By so much the way from the ball to a triangle may have become shorter.
double FacePoints::wayOf(const Vec3& center, const Group& group) const {
  return moved_ + (center - group.center_W).norm();
}

// Whether the ball was in front of the surface, and since then neither went so far that it could be
// behind it, or nearer than `within`.
bool FacePoints::staysAway(const std::vector<PlacedObstacle>& placed, const Group& group,
                           double within) const {
  if (!skip_far_ || group.behind) return false;
  const double apart = by_distance_[group.begin].apart;
  return apart - wayOf(centerOf(placed, group), group) > withSlack(within);
}

// Fills close_ with the candidates that may be the nearest or nearer than `within`, in their order.
// After a leap each of hundreds of balls has hundreds, in each trial of a line search.
void FacePoints::findNear(const Points& x, const Vec3& center, const Group& group,
                          double within) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double moved = wayOf(center, group);
  double nearest = kNone;  // that one is, at most,
  double far = kNone;      // and that one may be that matters
  int nearest_triangle = -1;
  close_.clear();
  for (int k = group.begin; k < group.end; ++k) {
    const Ordered& one = by_distance_[k];
    if (one.apart - moved > far) break;
    const auto ball = around_.col(one.triangle);
    const double squared = (center - ball.head<3>()).squaredNorm();
    const double most = far + ball[3];
    if (squared > most * most) continue;
    close_.emplace_back(one.candidate, std::sqrt(squared));
    if (!(close_.back().second < nearest)) continue;
    nearest = close_.back().second;
    nearest_triangle = one.triangle;
    if (skip_far_) far = withSlack(std::max(nearest, within));
  }
  if (skip_far_ && close_.size() > kFew && nearest_triangle >= 0) {
    const Mat3 at = corners(x, nearest_triangle);
    const TrianglePoint near = nearestOnTriangle(center, at.col(0), at.col(1), at.col(2));
    far = std::min(far, withSlack(std::max((center - near.point).norm(), within)));
  }
  const auto too_far = [&](const std::pair<int, double>& close) {
    return close.second - around_(3, candidates_[close.first].triangle) > far;
  };
  close_.erase(std::remove_if(close_.begin(), close_.end(), too_far), close_.end());
  std::sort(close_.begin(), close_.end());
}

}  // namespace palpate::contact
