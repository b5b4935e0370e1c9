// SPDX-License-Identifier: GPL-3.0-or-later
#include "at_surface.h"

#include <Eigen/LU>
#include <limits>

namespace palpate::torture {

OnSurface nearestOnSurface(const tissue::SurfaceState& shape, const Vec3& p_W) {
  double nearest = std::numeric_limits<double>::infinity();
  OnSurface found;
  for (Eigen::Index t = 0; t < shape.triangles.cols(); ++t) {
    const Eigen::Vector3i tri = shape.triangles.col(t);
    Eigen::Matrix<double, 3, 2> D;
    const Vec3 a = shape.positions.col(tri[0]), p = p_W - a;
    D << Vec3(shape.positions.col(tri[1])) - a, Vec3(shape.positions.col(tri[2])) - a;
    const Eigen::Vector2d s = (D.transpose() * D).inverse() * (D.transpose() * p);
    const Vec3 w = Vec3(1.0 - s.sum(), s[0], s[1]).cwiseMax(0.0);
    const Vec3 inside = w / w.sum();
    const double off = (D * inside.tail<2>() - p).norm();
    if (!(off < nearest)) continue;
    nearest = off;
    found = {tri, inside};
  }
  return found;
}

}  // namespace palpate::torture
