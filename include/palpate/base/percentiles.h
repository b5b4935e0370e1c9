// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace palpate {

// All by the nearest rank: the least of the values that a share `q` of them, in [0, 1], does not
// exceed. So a percentile is always one of the values. 0 where there is none.

double quantileOfSorted(const std::vector<double>& ascending, double q);
double quantile(std::vector<double> values, double q);

struct Percentiles {
  double p50 = 0.0, p99 = 0.0, max = 0.0;
};
Percentiles percentiles(std::vector<double> values);

}  // namespace palpate
