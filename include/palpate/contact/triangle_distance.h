// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "palpate/base/types.h"

namespace palpate::contact {

/// Kind of the feature of a triangle or polyhedron that is nearest to a point.
enum class Feature { kFace, kEdge, kVertex };

struct TrianglePoint {
  Vec3 point;    ///< Of the triangle.
  Vec3 weights;  ///< Its barycentric coordinates.
  Feature feature;
  int corner;  ///< Index of a vertex, or of the corner where an edge begins.
};

/// The point of the triangle a, b, c that is nearest to p.
TrianglePoint nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Second derivative of the distance of a fixed point p from a triangle by the triangle's corners,
/// 9 x 9 [1/m], corner by corner. `x`: the corners; `m`: unit, from the nearest point `near` to p,
/// or opposite, and `distance` [m] then negative, so that p = near.point + distance m. Zero where p
/// is nearer than 1e-9 m to an edge or a corner.
Eigen::Matrix<double, 9, 9> triangleDistanceHessian(const Mat3& x, const TrianglePoint& near,
                                                    const Vec3& m, double distance);

}  // namespace palpate::contact
