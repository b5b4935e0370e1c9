// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/base/types.h"
#include "particle_tree.h"

namespace palpate::tissue {

/// How points of a surface follow particles: by moving least squares of first order over the
/// particles around each [Lancaster, Salkauskas 1981], so that what is linear in space is exact,
/// and forces on the surface come to the particles with their sum and moment.
class SurfaceLinks {
 public:
  /// Of points X at rest, 3 x n [m]; `leaves` of the tree.
  void build(const Points& X, const ParticleTree& tree, const std::vector<int>& leaves);
  /// values (3 x n) = those of the leaves, 3 x m, there.
  void interpolate(const Points& of_leaves, Points* values) const;
  /// on_leaves (3 x m) += forces on the points, 3 x n.
  void addForces(const Points& on_points, Points* on_leaves) const;
  /// Of each leaf, += what a stiffness at each point, n [N/m], is for it at most.
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
