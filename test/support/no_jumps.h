// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "palpate/fem/energy_term.h"

namespace palpate::test {

/// From x along d, 3 x n, in steps of h, the energy changes by no more than the steeper of its
/// slopes where a step begins and ends: a line search finds no way over a jump.
inline void expectNoJumps(const fem::EnergyTerm& term, const Points& x, const Points& d, double h,
                          int steps) {
  const auto slope_at = [&](const Points& at) {
    Points g = Points::Zero(3, at.cols());
    term.addGradient(at, &g);
    return std::abs(g.cwiseProduct(d).sum());
  };
  double value = term.value(x), slope = slope_at(x), largest = std::abs(value);
  for (int k = 1; k <= steps; ++k) {
    const Points at = x + k * h * d;
    const double next = term.value(at), next_slope = slope_at(at);
    largest = std::max(largest, std::abs(next));
    ASSERT_LE(std::abs(next - value), 1.05 * h * std::max(slope, next_slope) + 1e-6 * largest)
        << k << " steps from where it began";
    value = next;
    slope = next_slope;
  }
}

}  // namespace palpate::test
