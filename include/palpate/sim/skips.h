// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/sim/scene.h"
#include "palpate/sim/step_report.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::sim {

/// A kind of work that cycles leave out: its key below `solver.skip`, its counter in the report.
struct Skip {
  const char* key;
  bool SkipConfig::*on;
  const char* doc;      ///< What is left out, for the table of keys.
  const char* counter;  ///< Name of the counter; null where no cycle of the simulation counts it.
  std::int64_t SkipCounters::*count;
  int (*of)(const tissue::TissueStep&);  ///< An organ's cycle adds this to the counter.
  bool in_total;  ///< Counts pieces of work large enough for SkipCounters::total().
};

/// Every skip. To add one: a switch, a counter, and a line in skips.cpp, which the scene's keys,
/// the sums, `palpate replay --profile`, /diagnostics and the tests read; and its counter in
/// StepReport.msg.
const std::vector<Skip>& skips();

}  // namespace palpate::sim
