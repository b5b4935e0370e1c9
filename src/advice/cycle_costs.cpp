// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/advice/cycle_costs.h"

#include <algorithm>

#include "palpate/base/percentiles.h"

namespace palpate::advice {

void CostRecorder::add(const sim::StepReport& report, double seconds, int parts) {
  if (parts < 1) return;
  Cycle cycle{seconds / parts, report.phases, double(report.newton_iterations) / parts,
              double(report.linear_iterations) / parts, double(report.sweep_stages)};
  for (std::size_t k = 0; k < kNumPhases; ++k) cycle.phases[static_cast<Phase>(k)] /= parts;
  cycles_.insert(cycles_.end(), parts, cycle);
  skipped_ += report.skipped;
}

CycleCosts CostRecorder::figures() const {
  CycleCosts f;
  const std::size_t n = cycles_.size();
  if (n == 0) return f;
  f.cycles = static_cast<long>(n);
  f.skipped = skipped_;
  double newton = 0.0, linear = 0.0;
  for (const Cycle& c : cycles_) {
    f.total += c.phases;
    newton += c.newton;
    linear += c.linear;
  }
  f.newton_per_cycle = newton / static_cast<double>(n);
  f.linear_per_newton = newton > 0.0 ? linear / newton : 0.0;

  std::vector<double> sorted(n);
  for (std::size_t k = 0; k < kNumPhases; ++k) {
    const Phase phase = static_cast<Phase>(k);
    for (std::size_t i = 0; i < n; ++i) sorted[i] = cycles_[i].phases[phase];
    std::sort(sorted.begin(), sorted.end());
    f.median[phase] = quantileOfSorted(sorted, 0.5);
    f.p99[phase] = quantileOfSorted(sorted, 0.99);
  }
  for (std::size_t i = 0; i < n; ++i) sorted[i] = cycles_[i].seconds;
  std::sort(sorted.begin(), sorted.end());
  f.cycle_median = quantileOfSorted(sorted, 0.5);
  f.cycle_p99 = quantileOfSorted(sorted, 0.99);

  const double slow = sorted[n - std::max<std::size_t>(1, n / 20)];
  double count = 0.0;
  for (const Cycle& c : cycles_) {
    if (c.seconds < slow) continue;
    f.slow += c.phases;
    f.stages_per_cycle += c.stages;
    count += 1.0;
  }
  for (std::size_t k = 0; k < kNumPhases; ++k) f.slow[static_cast<Phase>(k)] /= count;
  f.stages_per_cycle /= count;
  return f;
}

}  // namespace palpate::advice
