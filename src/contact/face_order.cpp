// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the triangles that a tool's balls may touch are looked at.
#include <algorithm>
#include <cmath>
#include <limits>

#include "face_points.h"

namespace palpate::contact {
namespace {

// More than what counts as equally near: of a distance, and [m].
constexpr double kSlack = 1e-8, kLeastSlack = 1e-12;

// More triangles than so many are worth asking how far one of them is, not only its middle.
constexpr std::size_t kFew = 4;

// Of a triangle's edges: farther from where they were put in order, candidates are put in order
// anew, if that happens more than so many times.
constexpr double kFarFromOrder = 0.5;
constexpr int kPatience = 8;

double withSlack(double distance) { return distance * (1.0 + kSlack) + kLeastSlack; }

// Flatter triangles [of the squared radius of a ball around them] have no plane to speak of; the
// others are that near to theirs [of the radius].
constexpr double kNoPlane = 1e-5, kOffPlane = 1e-8;

}  // namespace

// How far the triangle is from there, at least: it lies in the disc in which its plane cuts the
// ball around it. Deep in the tissue the ball alone would let most of the surface be the nearest.
double FacePoints::leastDistance(const Vec3& center, int triangle) const {
  const auto around = around_.col(triangle);
  const Vec3 way = center - around.head<3>();
  const double radius = around[3];
  const double height = planes_.col(triangle).dot(way);
  const double across = std::sqrt(std::max(0.0, way.squaredNorm() - height * height)) - radius;
  const double up = std::max(0.0, std::abs(height) - kOffPlane * radius);
  return std::sqrt(up * up + std::max(0.0, across) * std::max(0.0, across));
}

// The candidates of a group by their distances.
void FacePoints::order(const Group& group) const {
  std::sort(by_distance_.begin() + group.begin, by_distance_.begin() + group.end,
            [](const Ordered& a, const Ordered& b) { return a.apart < b.apart; });
}

// Whether the balls are asked for again and again where they have gone so far, or the tissue, that
// what was far from them is no more known to be.
bool FacePoints::disordered(const std::vector<PlacedObstacle>& placed) const {
  if (!skip_far_) return false;
  const auto far = [&](const Group& group) {
    return moved_ + (centerOf(placed, group) - group.ordered_W).norm() > kFarFromOrder * group.edge;
  };
  return std::any_of(groups_.begin(), groups_.end(), far) && ++disordered_ > kPatience;
}

// By their least distances, which is enough.
void FacePoints::orderAgain(const Points& x, const std::vector<PlacedObstacle>& placed) const {
  ordered_at_ = x;
  moved_ = 0.0;
  for (Group& group : groups_) {
    group.ordered_W = centerOf(placed, group);
    for (int c = group.begin; c < group.end; ++c) {
      const int triangle = candidates_[c].triangle;
      by_distance_[c] = {leastDistance(group.ordered_W, triangle), c, triangle};
    }
    order(group);
  }
  disordered_ = 0;
}

void FacePoints::placeTriangles(const Points& x) const {
  double since_found = 0.0, since_ordered = 0.0;
  for (const int t : used_) {
    const Mat3 at = corners(x, t);
    const auto wayFrom = [&](const Points& there) {
      return (at - corners(there, t)).colwise().squaredNorm().maxCoeff();
    };
    since_found = std::max(since_found, wayFrom(found_at_));
    since_ordered = std::max(since_ordered, wayFrom(ordered_at_));
    const Vec3 middle = at.rowwise().mean();
    const double squared = (at.colwise() - middle).colwise().squaredNorm().maxCoeff();
    around_.col(t) << middle, std::sqrt(squared);
    const Vec3 normal = (at.col(1) - at.col(0)).cross(at.col(2) - at.col(0));
    normals_.col(t) = normal.normalized();
    const bool flat = !(normal.squaredNorm() > kNoPlane * kNoPlane * squared * squared);
    planes_.col(t) = flat ? Vec3(Vec3::Zero()) : Vec3(normals_.col(t));
  }
  moved_since_found_ = std::sqrt(since_found);
  moved_ = std::sqrt(since_ordered);
}

// Whether the ball was in front of the surface when it was found, and since then neither went so
// far that it could be behind it, or nearer than `within`.
bool FacePoints::staysAway(const std::vector<PlacedObstacle>& placed, const Group& group,
                           double within) const {
  if (!skip_far_ || group.behind) return false;
  const double way = moved_since_found_ + (centerOf(placed, group) - group.center_W).norm();
  return group.apart - way > withSlack(within);
}

// Fills close_ with the candidates that may be the nearest or nearer than `within`, in their order.
// After a leap each of hundreds of balls has hundreds, in each trial of a line search.
void FacePoints::findNear(const Points& x, const Vec3& center, const Group& group,
                          double within) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double moved = moved_ + (center - group.ordered_W).norm();
  double nearest = kNone;  // that one is, at most,
  double far = kNone;      // and that one may be that matters
  int nearest_triangle = -1;
  close_.clear();
  for (int k = group.begin; k < group.end; ++k) {
    const Ordered& one = by_distance_[k];
    if (one.apart - moved > far) break;
    const auto around = around_.col(one.triangle);
    const double squared = (center - around.head<3>()).squaredNorm();
    const double most = far + around[3];
    if (squared > most * most) continue;
    const double least = leastDistance(center, one.triangle);
    if (least > far) continue;
    close_.emplace_back(one.candidate, least);
    if (!(squared < nearest * nearest)) continue;
    nearest = std::sqrt(squared);
    nearest_triangle = one.triangle;
    if (skip_far_) far = withSlack(std::max(nearest, within));
  }
  if (skip_far_ && close_.size() > kFew && nearest_triangle >= 0) {
    const Mat3 at = corners(x, nearest_triangle);
    const TrianglePoint near = nearestOnTriangle(center, at.col(0), at.col(1), at.col(2));
    far = std::min(far, withSlack(std::max((center - near.point).norm(), within)));
  }
  const auto too_far = [&](const std::pair<int, double>& close) { return close.second > far; };
  close_.erase(std::remove_if(close_.begin(), close_.end(), too_far), close_.end());
  std::sort(close_.begin(), close_.end());
}

}  // namespace palpate::contact
