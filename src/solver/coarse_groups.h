// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/base/types.h"
#include "sliced_rows.h"

namespace palpate::solver {

/// Overlapping groups of neighbouring nodes. A node has weights for the kGroupsOfANode groups with
/// the nearest centres. Weights fall to zero where the next centre is equally near, and sum to one
/// [as Shepard 1968 interpolates; with local support Franke, Nielson 1980].
struct CoarseGroups {
  /// Centres are those of `size` consecutive nodes each of `nodes`.
  CoarseGroups(const Points& points, const SliceOrder& nodes, int size);

  int count() const { return static_cast<int>(middle.cols()); }

  Points middle;           ///< Centre of each group [m].
  Eigen::VectorXd radius;  ///< Radius of each group's own nodes [m].
  std::vector<int> group;  ///< [node][kGroupsOfANode]
  std::vector<double> weight;
};

}  // namespace palpate::solver
