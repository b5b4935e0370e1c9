// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/tissue/figures.h"
#include "palpate/tissue/skips.h"

namespace palpate::sim {

/// Report of a cycle over all organs and instruments. reportFigures() documents each figure and how
/// those of organs and sub-steps merge.
struct StepReport : tissue::StepFigures {
  double time = 0.0;  ///< [s]
  double step = 0.0;  ///< [s]
  int contacts = 0;
  double max_penetration = 0.0;  ///< [m]
  double imbalance = 0.0;        ///< [N], see docs.
  int nodes = 0;                 ///< Nodes of all organs' present meshes.
  int mesh_changes = 0;          ///< Mesh adaptations in the cycle.
  std::uint64_t state_hash = 0;  ///< StateHash of positions, velocities and wrenches.
  tissue::SkipCounters skipped;

  /// Whether the final state is a valid solution, if not to full accuracy.
  bool usable() const { return solver::usable(status); }
};

/// tissue::stepFigures() and figures of reports alone, in the order of StepReport.msg.
const std::vector<tissue::Figure<StepReport>>& reportFigures();

/// Merges `earlier` sub-steps into `report`.
void addSubSteps(const StepReport& earlier, StepReport* report);

}  // namespace palpate::sim
