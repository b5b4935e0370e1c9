// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/types.h"
#include "particle_tree.h"

namespace palpate::tissue {

/// Interpolation from particles to surface points by first-order moving least squares [Lancaster,
/// Salkauskas 1981]: exact for linear fields; its transpose conserves forces and moments.
class SurfaceLinks {
 public:
  /// `X`: rest positions of the points, 3 x n [m]; `leaves`: of the tree.
  void build(const Points& X, const ParticleTree& tree, const std::vector<int>& leaves);
  /// Interpolates values of the leaves, 3 x m, to the points, 3 x n.
  void interpolate(const Points& of_leaves, Points* values) const;
  /// on_leaves (3 x m) += forces on the points, 3 x n.
  void addForces(const Points& on_points, Points* on_leaves) const;
  /// Adds an upper bound of each leaf's stiffness by that of the points, n [N/m].
  void addStiffness(const Eigen::VectorXd& of_points, Eigen::VectorXd* of_leaves) const;

 private:
  struct Weight {
    int leaf;
    double weight;
  };
  std::vector<int> start_;
  std::vector<Weight> weights_;
};

}  // namespace palpate::tissue
