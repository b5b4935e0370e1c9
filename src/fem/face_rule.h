// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/material/tensor.h"

namespace palpate::fem {

/// An integration point of a triangle with 3 or 6 nodes (corners, mid-edge nodes of 01 12 20).
struct FacePoint {
  double weight;                    ///< For the reference triangle, of area 1/2.
  Eigen::VectorXd N, dN_dr, dN_ds;  ///< Shape functions and their derivatives.

  template <class Nodes>
  Vec3 interpolate(const Points& x, const Nodes& nodes, const Eigen::VectorXd& weights) const {
    Vec3 sum = Vec3::Zero();
    for (Eigen::Index a = 0; a < weights.size(); ++a) sum += weights[a] * x.col(nodes[a]);
    return sum;
  }
  /// dx/dr x dx/ds, outward.
  template <class Nodes>
  Vec3 areaVector(const Points& x, const Nodes& nodes) const {
    return interpolate(x, nodes, dN_dr).cross(interpolate(x, nodes, dN_ds));
  }
};

/// One point for 3 nodes, six of order 4 [Dunavant 1985] for 6 nodes: exact for a pressure.
const std::vector<FacePoint>& faceRule(Eigen::Index num_nodes);

}  // namespace palpate::fem
