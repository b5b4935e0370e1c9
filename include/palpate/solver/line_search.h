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

  /// Moves `x`, its gradient `g` and `value` to the first acceptable point along `direction`.
  /// Returns false, without changes, where there is none, or where `interrupt`, polled after
  /// `least_halvings`, is true; it may be null. No node moves farther than four radii of gyration
  /// of all nodes.
  /// @pre `direction` is zero on held components.
  bool run(const Potential& potential, const Points& direction, Points* x, Points* g, double* value,
           const Interrupt* interrupt = nullptr, int least_halvings = 1);
  /// Halvings of the last run().
  int halvings() const { return halvings_; }

 private:
  const Points& bounded(const Points& x, const Points& g, const Points& d);

  Points x_trial_, g_trial_, d_;
  int halvings_ = 0;
};

}  // namespace palpate::solver
