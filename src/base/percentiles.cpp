// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/percentiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace palpate {

double quantileOfSorted(const std::vector<double>& ascending, double q) {
  if (ascending.empty()) return 0.0;
  const double rank = std::ceil(q * static_cast<double>(ascending.size()));
  return ascending[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return quantileOfSorted(values, q);
}

Percentiles percentiles(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {quantileOfSorted(values, 0.5), quantileOfSorted(values, 0.99),
          quantileOfSorted(values, 1.0)};
}

}  // namespace palpate
