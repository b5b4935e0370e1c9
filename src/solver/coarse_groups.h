// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/base/types.h"
#include "sliced_rows.h"

namespace palpate::solver {

/// Overlapping groups of neighbouring nodes. A node has parts in the kGroupsOfANode groups whose
/// middles are nearest to it. Weights fall to nothing where the next middle is as near, and sum to
/// one [as Shepard 1968 interpolates; with local support Franke, Nielson 1980].
struct CoarseGroups {
  /// Groups of `size` nodes each, that follow one another in `nodes`, have their middles.
  CoarseGroups(const Points& points, const SliceOrder& nodes, int size);

  int count() const { return static_cast<int>(middle.cols()); }

  Points middle;           ///< [m], of each group.
  Eigen::VectorXd radius;  ///< [m], of each group's own nodes.
  std::vector<int> group;  ///< [node][kGroupsOfANode]
  std::vector<double> weight;
};

}  // namespace palpate::solver
