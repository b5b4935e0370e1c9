// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace palpate::contact {
namespace {

constexpr double kThinnestPart = 0.1;  // fraction of the surface that is thinner than radius() [-]

// The part of `direction` after which a ray from `from` meets the triangle with these corners,
// or infinity [Moeller and Trumbore 1997].
double rayIntersects(const Vec3& from, const Vec3& direction, const Mat3& corners) {
  const double nothing = std::numeric_limits<double>::infinity();
  const Vec3 u = corners.col(1) - corners.col(0), v = corners.col(2) - corners.col(0);
  const Vec3 across = direction.cross(v);
  const double volume = u.dot(across);
  if (volume == 0.0) return nothing;
  const Vec3 way = from - corners.col(0), turned = way.cross(u);
  const double a = way.dot(across) / volume, b = direction.dot(turned) / volume;
  if (a < 0.0 || b < 0.0 || a + b > 1.0) return nothing;
  return v.dot(turned) / volume;
}

}  // namespace

ContactSurface::ContactSurface(const Points& X, const Eigen::Matrix3Xi& triangles)
    : X_(X),
      triangles_(triangles),
      samples_(sampleSurface(X, triangles, std::numeric_limits<double>::infinity())),
      tree_(X, triangles) {
  findNeighbours();
  measure();
}

double ContactSurface::depth() const {
  return std::max(0.5 * mean_edge_, std::min(radius_, mean_edge_));
}

void ContactSurface::findNeighbours() {
  const Eigen::Index count = triangles_.cols();
  beyond_.setConstant(3, count, -1);
  std::map<std::pair<int, int>, std::pair<int, int>> edges;  // to a triangle and its corner
  around_start_.assign(static_cast<std::size_t>(X_.cols()) + 1, 0);
  for (Eigen::Index t = 0; t < count; ++t) {
    for (int k = 0; k < 3; ++k) {
      const int from = triangles_(k, t), to = triangles_((k + 1) % 3, t);
      ++around_start_[static_cast<std::size_t>(from) + 1];
      edges[{from, to}] = {static_cast<int>(t), k};
      const auto other = edges.find({to, from});
      if (other == edges.end()) continue;
      beyond_(k, t) = other->second.first;
      beyond_(other->second.second, other->second.first) = static_cast<int>(t);
    }
  }
  for (std::size_t i = 1; i < around_start_.size(); ++i) around_start_[i] += around_start_[i - 1];
  around_.resize(static_cast<std::size_t>(3 * count));
  std::vector<int> end(around_start_.begin(), around_start_.end() - 1);
  for (Eigen::Index t = 0; t < count; ++t) {
    for (int k = 0; k < 3; ++k) {
      around_[static_cast<std::size_t>(end[static_cast<std::size_t>(triangles_(k, t))]++)] =
          static_cast<int>(t);
    }
  }
}

// The thickness at a triangle is how far one sees inward from its middle.
void ContactSurface::measure() {
  std::vector<TriangleTree::Box> boxes;
  tree_.fit(X_, triangles_, &boxes);
  const auto count = static_cast<int>(triangles_.cols());
  std::vector<double> thickness;
  thickness.reserve(static_cast<std::size_t>(count));
  middles_.resize(3, count);
  sizes_.resize(count);
  for (int t = 0; t < count; ++t) {
    const Mat3 own = corners(X_, t);
    for (int k = 0; k < 3; ++k) {
      mean_edge_ += (own.col((k + 1) % 3) - own.col(k)).norm() / (3.0 * count);
    }
    middles_.col(t) = own.rowwise().mean();
    sizes_[t] = (own.colwise() - middles_.col(t)).colwise().norm().maxCoeff();
    const Vec3 from = middles_.col(t), inward = -normal(X_, t);
    double least = boxes[0].diagonal().norm();
    tree_.forRay(boxes, from, inward, [&](int other) {
      if (other == t) return;
      const double way = rayIntersects(from, inward, corners(X_, other));
      if (way > 0.0) least = std::min(least, way);
    });
    thickness.push_back(least);
  }
  const auto thin = thickness.begin() + static_cast<std::ptrdiff_t>(kThinnestPart * count);
  std::nth_element(thickness.begin(), thin, thickness.end());
  radius_ = 0.5 * *thin;
}

Mat3 ContactSurface::corners(const Eigen::Ref<const Points>& x, int triangle) const {
  Mat3 corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = x.col(triangles_(k, triangle));
  return corners;
}

Vec3 ContactSurface::normal(const Eigen::Ref<const Points>& x, int triangle) const {
  const Vec3 a = x.col(triangles_(0, triangle)), b = x.col(triangles_(1, triangle)),
             c = x.col(triangles_(2, triangle));
  return (b - a).cross(c - a).normalized();
}

Vec3 ContactSurface::pseudonormal(const Eigen::Ref<const Points>& x, int triangle,
                                  const TrianglePoint& near) const {
  if (near.feature == Feature::kFace) return normal(x, triangle);
  if (near.feature == Feature::kEdge) {
    const int other = beyond_(near.corner, triangle);
    if (other < 0) return normal(x, triangle);
    return (normal(x, triangle) + normal(x, other)).normalized();
  }
  const int node = triangles_(near.corner, triangle);
  Vec3 sum = Vec3::Zero();
  for (int k = around_start_[static_cast<std::size_t>(node)];
       k < around_start_[static_cast<std::size_t>(node) + 1]; ++k) {
    const int t = around_[static_cast<std::size_t>(k)];
    int c = 0;
    while (triangles_(c, t) != node) ++c;
    const Vec3 here = x.col(node), u = Vec3(x.col(triangles_((c + 1) % 3, t))) - here,
               v = Vec3(x.col(triangles_((c + 2) % 3, t))) - here;
    const Vec3 across = u.cross(v);
    sum += std::atan2(across.norm(), u.dot(v)) * across.normalized();
  }
  return sum.normalized();
}

std::shared_ptr<const ContactSurface> makeContactSurface(const Points& X,
                                                         const Eigen::Matrix3Xi& triangles) {
  return std::make_shared<const ContactSurface>(X, triangles);
}

bool isOf(const ContactSurface& surface, const Points& X, const Eigen::Matrix3Xi& triangles) {
  const bool fits =
      surface.atRest().cols() == X.cols() && surface.triangles().cols() == triangles.cols();
  return fits && surface.atRest() == X && surface.triangles() == triangles;
}

}  // namespace palpate::contact
