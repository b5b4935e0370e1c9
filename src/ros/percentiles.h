// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace palpate::node {

struct Percentiles {
  double p50 = 0.0, p99 = 0.0, max = 0.0;
};

/// By the nearest-rank rule; zeros if there are no values. Reorders `values`.
inline Percentiles percentiles(std::vector<double>* values) {
  if (values->empty()) return {};
  std::sort(values->begin(), values->end());
  const auto rank = [&](double share) {
    const double n = std::ceil(share * static_cast<double>(values->size()));
    return (*values)[static_cast<std::size_t>(std::max(1.0, n)) - 1];
  };
  return {rank(0.50), rank(0.99), values->back()};
}

}  // namespace palpate::node
