// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "triangle_potentials.h"

namespace palpate::bem {

/// Points of a triangle, 3 x q barycentric, and weights with sum 1.
struct OuterRule {
  Eigen::Matrix3Xd at;
  Eigen::VectorXd weights;
};

/// Quadrature over the triangle `over` of the potential of `source`, by their distance over the
/// size of `over`. The potential has r ln r kinks at edges, so triangles that touch or nearly do
/// use 75 points that are denser near edges; others use 7 or 3 [Dunavant 1985].
const OuterRule& outerRule(const Triangle& over, const Triangle& source);

}  // namespace palpate::bem
