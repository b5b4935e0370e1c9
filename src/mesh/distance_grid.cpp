// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/mesh/distance_grid.h"

#include <algorithm>
#include <cmath>

namespace palpate::mesh {
namespace {

Vec3 nearestInBox(const GridBox& box, const Vec3& p) {
  return p.cwiseMax(box.low).cwiseMin(box.high());
}

}  // namespace

double DistanceGrid::value(const Vec3& p) const {
  const Vec3 q = nearestInBox(field.box, p);
  const double inside = field.value(q);
  const double beyond = (p - q).squaredNorm();
  return beyond == 0.0 ? inside : std::sqrt(beyond + inside * inside);
}

FieldPoint DistanceGrid::at(const Vec3& p) const {
  const Vec3 q = nearestInBox(field.box, p);
  const FieldPoint on_box = field.at(q);
  const double beyond = (p - q).squaredNorm();
  if (beyond == 0.0) return on_box;

  // f^2 = |p - q|^2 + s(q)^2; q moves with p along axes on which p is within the box.
  FieldPoint point;
  const double f = std::sqrt(beyond + on_box.value * on_box.value);
  const Vec3 follows = (p.array() == q.array()).cast<double>();
  const Vec3 slope = on_box.gradient.cwiseProduct(follows);
  const Mat3 stays = (1.0 - follows.array()).matrix().asDiagonal();
  point.value = f;
  point.gradient = ((p - q) + on_box.value * slope) / f;
  point.hessian = (stays + slope * slope.transpose() +
                   on_box.value * (follows * follows.transpose()).cwiseProduct(on_box.hessian) -
                   point.gradient * point.gradient.transpose()) /
                  f;
  return point;
}

}  // namespace palpate::mesh
