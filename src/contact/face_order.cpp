// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the triangles that a tool's balls may touch are looked at.
#include <algorithm>
#include <cmath>
#include <limits>

#include "face_points.h"

namespace palpate::contact {
namespace {

// More triangles than so many are worth asking how far one of them is, not only its middle.
constexpr std::size_t kFew = 4;

// Flatter triangles have no plane to speak of [of the squared radius of a ball around them].
constexpr double kNoPlane = 1e-5;

}  // namespace

// The candidates of a group by their distances.
void FacePoints::order(const Group& group) {
  std::sort(by_distance_.begin() + group.begin, by_distance_.begin() + group.end,
            [](const Ordered& a, const Ordered& b) { return a.apart < b.apart; });
}

void FacePoints::placeTriangles(const Points& x) const {
  double moved = 0.0;
  for (const int t : used_) {
    const Mat3 at = corners(x, t);
    moved = std::max(moved, (at - corners(found_at_, t)).colwise().squaredNorm().maxCoeff());
    const Vec3 middle = at.rowwise().mean();
    const double squared = (at.colwise() - middle).colwise().squaredNorm().maxCoeff();
    around_.col(t) << middle, std::sqrt(squared);
    const Vec3 normal = (at.col(1) - at.col(0)).cross(at.col(2) - at.col(0));
    normals_.col(t) = normal.normalized();
    const bool flat = !(normal.squaredNorm() > kNoPlane * kNoPlane * squared * squared);
    planes_.col(t) = flat ? Vec3(Vec3::Zero()) : Vec3(normals_.col(t));
  }
  moved_ = std::sqrt(moved);
}

// Whether the ball was in front of the surface when it was found, and since then neither went so
// far that it could be behind it, or nearer than `within`.
bool FacePoints::staysAway(const std::vector<PosedObstacle>& posed, const Group& group,
                           double within) const {
  if (!skip_far_ || group.behind) return false;
  const double way = moved_ + (centerOf(posed, group) - group.center_W).norm();
  return group.apart - way > withSlack(within);
}

// Fills close_ with the candidates that may be the nearest or nearer than `within`, in their order.
// After a leap each of hundreds of balls has hundreds, in each trial of a line search: the triangle
// that was the nearest when they were asked last says how far away the nearest is at most.
void FacePoints::findNear(const Points& x, const Vec3& center, const Group& group,
                          double within) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto reachOf = [&](int triangle) {
    const Mat3 at = corners(x, triangle);
    const TrianglePoint near = nearestOnTriangle(center, at.col(0), at.col(1), at.col(2));
    return withSlack(std::max((center - near.point).norm(), within));
  };
  const double moved = moved_ + (center - group.center_W).norm();
  double far = skip_far_ ? reachOf(group.nearest) : kNone;  // that one may be that matters
  double nearest = kNone;                                   // that a middle is
  int nearest_triangle = group.nearest;
  close_.clear();
  for (int k = group.begin; k < group.end; ++k) {
    const Ordered& one = by_distance_[k];
    if (one.apart - moved > far) break;
    const double least = leastDistance(center, one.triangle, far);
    if (least > far) continue;
    close_.emplace_back(one.candidate, least);
    const double squared = (center - around_.col(one.triangle).head<3>()).squaredNorm();
    if (!(squared < nearest * nearest)) continue;
    nearest = std::sqrt(squared);
    nearest_triangle = one.triangle;
    if (skip_far_) far = std::min(far, withSlack(std::max(nearest, within)));
  }
  if (skip_far_ && close_.size() > kFew && nearest_triangle != group.nearest) {
    far = std::min(far, reachOf(nearest_triangle));
  }
  const auto too_far = [&](const std::pair<int, double>& close) { return close.second > far; };
  close_.erase(std::remove_if(close_.begin(), close_.end(), too_far), close_.end());
  std::sort(close_.begin(), close_.end());
}

}  // namespace palpate::contact
