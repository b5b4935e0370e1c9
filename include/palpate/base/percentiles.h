// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace palpate {

// Nearest-rank percentiles: the least value v with a share `q` in [0, 1] of the values <= v. Always
// one of the values; 0 without values.

double quantileOfSorted(const std::vector<double>& ascending, double q);
double quantile(std::vector<double> values, double q);

struct Percentiles {
  double p50 = 0.0, p99 = 0.0, max = 0.0;
};
Percentiles percentiles(std::vector<double> values);

}  // namespace palpate
