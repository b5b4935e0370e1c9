// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/solver/interrupt.h"
#include "palpate/solver/potential.h"

namespace palpate::solver {

/// Norm of the free components of g, 3 x n.
double freeNorm(const Points& g, const fem::FreeMask& free);

/// Backtracking along a direction d: Armijo's rule on the value [Nocedal, Wright 2006, alg. 3.1],
/// or on the norm of the free gradient where the potential has non-conservative terms or
/// differences of the value drown in rounding. Keeps its scratch memory between calls.
class LineSearch {
 public:
  static constexpr int kMaxHalvings = 30;

  /// `x`, `g` (all components of the gradient there) and `value` move to the first point that will
  /// do, and stay where they are if there is none, as where d goes uphill, or if `interrupt`, which
  /// may be null and is asked after `least_halvings`, comes before one is found: false.
  /// `direction` is zero on held components; no node goes farther than four times
  /// the radius of gyration of all nodes.
  bool run(const Potential& potential, const Points& direction, Points* x, Points* g, double* value,
           const Interrupt* interrupt = nullptr, int least_halvings = 1);
  /// Times that the last run() halved its step.
  int halvings() const { return halvings_; }

 private:
  const Points& bounded(const Points& x, const Points& g, const Points& d);

  Points x_trial_, g_trial_, d_;
  int halvings_ = 0;
};

}  // namespace palpate::solver
