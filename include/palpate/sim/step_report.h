// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/tissue/figures.h"
#include "palpate/tissue/skips.h"

namespace palpate::sim {

/// What one cycle did, of all organs and instruments. What each figure means and how those of
/// organs and of sub-steps become one stands in reportFigures().
struct StepReport : tissue::StepFigures {
  double time = 0.0;  ///< [s]
  double step = 0.0;  ///< [s]
  int contacts = 0;
  double max_penetration = 0.0;  ///< [m]
  double imbalance = 0.0;        ///< [N], see docs.
  int nodes = 0;                 ///< Of all organs' meshes, as they are now.
  int mesh_changes = 0;          ///< How often the mesh of an organ became another in the cycle.
  std::uint64_t state_hash = 0;  ///< StateHash of what the simulator shows after the cycle.
  tissue::SkipCounters skipped;

  /// The state at the end is one that the tissue really took, if not to full accuracy.
  bool usable() const { return solver::usable(status); }
};

/// tissue::stepFigures() and what only a report has, in the order of StepReport.msg.
const std::vector<tissue::Figure<StepReport>>& reportFigures();

/// `report`, of a sub-step, becomes that of it and the earlier ones.
void addSubSteps(const StepReport& earlier, StepReport* report);

}  // namespace palpate::sim
