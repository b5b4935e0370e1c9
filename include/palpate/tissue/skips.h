// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "palpate/tissue/skip_switches.h"
#include "palpate/tissue/tissue_model.h"

namespace palpate::tissue {

/// Counters of work that a cycle skipped.
struct SkipCounters {
  std::int64_t far_bodies = 0;  ///< Tool shapes that cannot touch in this cycle: no contact search.
  std::int64_t sleeping_organs = 0;   ///< At rest and untouched: no solve.
  std::int64_t sleeping_islands = 0;  ///< Parts of organs, likewise.
  std::int64_t satisfied_solves =
      0;  ///< The predictor was already within tolerance: no Newton iteration.
  std::int64_t distant_samples =
      0;  ///< Surface points, times near tool shapes, that were out of reach.
  std::int64_t inactive_samples =
      0;  ///< Those within reach that did not touch at the end: no derivative.
  std::int64_t frictionless_touches = 0;  ///< Contacts that have no friction: none was evaluated.
  std::int64_t inviscid_solids = 0;   ///< Solids of solved organs without viscous terms: no memory.
  std::int64_t kept_stiffnesses = 0;  ///< Elastic stiffnesses that were not assembled again.
  std::int64_t still_points = 0;      ///< Points of springs that were left where they are.
  std::int64_t apart_organs = 0;      ///< Pairs of bodies that could not act on each other.

  /// Sum over Skip::in_total: shapes, organs, solves.
  std::int64_t total() const;
  SkipCounters& operator+=(const SkipCounters& other);
};

/// A kind of skipped work: its key below `solver.skip` and its counter in the report.
struct Skip {
  const char* key;
  bool SkipSwitches::*on;
  const char* doc;      ///< Description of the skipped work, for the table of keys.
  const char* counter;  ///< Name of the counter; null where no cycle counts it.
  std::int64_t SkipCounters::*count;
  /// Contribution of an organ's cycle to the counter: a number, or 1 where true.
  std::variant<int TissueStep::*, bool TissueStep::*> figure;
  bool in_total;  ///< Whether SkipCounters::total() includes the counter.

  int of(const TissueStep& step) const;
};

/// Every skip. To add one: a switch, a counter, and a line in skips.cpp, which the scene's keys,
/// the sums, `palpate replay --profile`, /diagnostics and the tests read; and its counter in
/// StepReport.msg.
const std::vector<Skip>& skips();

/// Merges the counters of an island or organ into those of the whole. Numbers are summed; flags are
/// true where true of all parts. Sleeping parts are counted where `over` is kParts.
void mergeSkips(Over over, const TissueStep& part, TissueStep* whole);

}  // namespace palpate::tissue
