// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "palpate/sim/step_report.h"

namespace palpate::advice {

/// Costs of cycles, for advice/scene_verdict.h. Times in [s].
struct CycleCosts {
  long cycles = 0;
  double cycle_median = 0.0, cycle_p99 = 0.0;  ///< Wall time of a cycle [s].
  PhaseTimes median, p99;  ///< Of each phase separately; they do not add up to the cycle's.
  PhaseTimes total;
  PhaseTimes slow;  ///< Mean over the slowest 5 % of the cycles.
  double newton_per_cycle = 0.0, linear_per_newton = 0.0;
  double stages_per_cycle = 0.0;  ///< Mean number of stages in the slowest 5 %.
  tissue::SkipCounters skipped;
};

/// Collects the reports of cycles.
class CostRecorder {
 public:
  /// `seconds`: wall time of the cycle, at least the sum of the report's phases. A report over
  /// `parts` steps counts as that many equal cycles.
  void add(const sim::StepReport& report, double seconds, int parts = 1);
  /// Nearest-rank percentiles; zeros without cycles.
  CycleCosts figures() const;
  /// Removes all cycles but keeps the memory.
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
