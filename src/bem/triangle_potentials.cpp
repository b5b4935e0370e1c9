// SPDX-License-Identifier: GPL-3.0-or-later
#include "triangle_potentials.h"

#include <Eigen/Geometry>
#include <cmath>

namespace palpate::bem {
namespace {

// Distance from the plane over the triangle's size up to which a point counts as in the plane.
constexpr double kInPlane = 1e-13;

// int dl / r along an edge, without cancellation; 0 for a point on the edge, where its factor is 0.
double edgeIntegral(double from_length, double from, double to_length, double to) {
  const bool ahead = from + to > 0.0;
  const double a = ahead ? from_length + from : to_length - to;
  const double b = ahead ? to_length + to : from_length - from;
  return a > 0.0 ? std::log(b / a) : 0.0;
}

}  // namespace

Triangle::Triangle(const Mat3& corners_by_column)
    : corners(corners_by_column), middle(corners.rowwise().mean()) {
  const Vec3 twice = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
  area = 0.5 * twice.norm();
  normal = twice / (2.0 * area);
  for (int a = 0; a < 3; ++a) {
    const Vec3 side = corners.col((a + 2) % 3) - corners.col((a + 1) % 3);
    gradients.col(a) = normal.cross(side) / (2.0 * area);
  }
  radius = (corners.colwise() - middle).colwise().norm().maxCoeff();
}

TrianglePotentials potentials(const Triangle& triangle, const Vec3& x) {
  const Vec3& n = triangle.normal;
  const Mat3 r = triangle.corners.colwise() - x;
  const Vec3 length = r.colwise().norm();
  double h = n.dot(r.col(0));
  if (std::abs(h) <= kInPlane * triangle.radius) h = 0.0;
  const double height = std::abs(h);
  double inverse = 0.0, angle = 0.0;  // |angle| is the solid angle over its sign
  Vec3 slide = Vec3::Zero();          // int of r's component in the plane over r^3
  Mat3 spread = Mat3::Zero();         // int of that component's dyad
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const Vec3 side = r.col(next) - r.col(k);
    const Vec3 s = side / side.norm(), m = s.cross(n);
    const double d = m.dot(r.col(k)), from = s.dot(r.col(k)), to = s.dot(r.col(next));
    const double log = edgeIntegral(length[k], from, length[next], to);
    const double square = d * d + h * h;
    if (d != 0.0) {
      angle += std::atan2(d * to, square + height * length[next]) -
               std::atan2(d * from, square + height * length[k]);
    }
    inverse += d * log;
    slide -= log * m;
    spread -= m * (d * log * m + (length[next] - length[k]) * s).transpose();
  }
  inverse -= height * angle;
  spread += inverse * (Mat3::Identity() - n * n.transpose());
  const Mat3 across = h * n * slide.transpose();
  TrianglePotentials found;
  found.inverse = inverse;
  found.pull = height * angle * n * n.transpose() + across + across.transpose() + spread;
  const double solid_angle = h > 0.0 ? angle : h < 0.0 ? -angle : 0.0;
  const Vec3 at_foot = (Vec3::UnitX() - triangle.gradients.transpose() * r.col(0));
  found.cover = solid_angle * at_foot + h * triangle.gradients.transpose() * slide;
  return found;
}

}  // namespace palpate::bem
