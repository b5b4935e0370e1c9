// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/selection.h"

#include <cmath>

namespace palpate::mesh {
namespace {

struct Inside {
  const Points& points;

  bool operator()(const PlaneRegion& plane, Eigen::Index i) const {
    return std::abs(points(plane.axis, i) - plane.at) <= plane.tolerance;
  }
  bool operator()(const BoxRegion& box, Eigen::Index i) const {
    return (points.col(i).array() >= box.min.array()).all() &&
           (points.col(i).array() <= box.max.array()).all();
  }
  bool operator()(const SphereRegion& sphere, Eigen::Index i) const {
    return (points.col(i) - sphere.center).norm() <= sphere.radius;
  }
};

Region withTolerance(Region region, const Points& points) {
  auto* plane = std::get_if<PlaneRegion>(&region);
  if (plane && plane->tolerance < 0.0 && points.cols() > 0) {
    plane->tolerance = 1e-9 * (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  }
  return region;
}

}  // namespace

std::vector<int> selectPoints(const Points& points, const Region& region) {
  std::vector<int> selected;
  const Inside inside{points};
  std::visit(
      [&](const auto& r) {
        for (Eigen::Index i = 0; i < points.cols(); ++i) {
          if (inside(r, i)) selected.push_back(static_cast<int>(i));
        }
      },
      withTolerance(region, points));
  return selected;
}

}  // namespace palpate::mesh
