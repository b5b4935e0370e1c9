// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/sim/step_report.h"

namespace palpate::advice {

/// What cycles cost, for advice/scene_verdict.h. Times in seconds.
struct CycleCosts {
  long cycles = 0;
  double cycle_median = 0.0, cycle_p99 = 0.0;  ///< Wall time of a cycle [s].
  PhaseTimes median, p99;  ///< Of each phase by itself, so that they do not add up.
  PhaseTimes total;
  PhaseTimes slow;  ///< Mean over the slowest twentieth of the cycles.
  double newton_per_cycle = 0.0, linear_per_newton = 0.0;
  double stages_per_cycle = 0.0;  ///< Of the sweep; the slowest twentieth.
  tissue::SkipCounters skipped;
};

/// Collects the cycles' reports.
class CostRecorder {
 public:
  /// `seconds`: wall time of the whole, at least what the report's phases add up to. A report that
  /// sums over several `parts` counts as that many equal cycles.
  void add(const sim::StepReport& report, double seconds, int parts = 1);
  /// Percentiles by the nearest rank; all zero without cycles.
  CycleCosts figures() const;
  /// Forgets the cycles, keeps the memory.
  void clear() {
    cycles_.clear();
    skipped_ = tissue::SkipCounters();
  }

 private:
  struct Cycle {
    double seconds;
    PhaseTimes phases;
    double newton, linear, stages;
  };
  tissue::SkipCounters skipped_;
  std::vector<Cycle> cycles_;
};

}  // namespace palpate::advice
