// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "triangle_potentials.h"

namespace palpate::bem {

/// Points of a triangle, 3 x q in the corners' coordinates, and their weights, which add up to 1.
struct OuterRule {
  Eigen::Matrix3Xd at;
  Eigen::VectorXd weights;
};

/// By which what `source` does is integrated over `over`, by their distance over the size of
/// `over`: the potential of a triangle has a kink of the kind r ln r at its edges, so that what
/// shares a corner or is as near gets 75 points that crowd towards all edges, and others 7 or 3
/// [Dunavant 1985].
const OuterRule& outerRule(const Triangle& over, const Triangle& source);

}  // namespace palpate::bem
