// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "palpate/solver/newton.h"

namespace palpate::solver {

struct StaticSettings {
  int load_steps = 1;
  double tolerance = 1e-9;  ///< On the residual, relative to the norm of loads and reactions.
  int max_newton_iterations = 50;
};

struct StaticReport {
  SolveStatus status = SolveStatus::kConverged;
  int load_steps = 0;  ///< Taken; more than asked for where one had to be cut.
  int newton_iterations = 0;
  double residual = 0.0;     ///< Relative, of the last converged load step.
  double load_factor = 0.0;  ///< Reached, 1 = everything.
};

/// Equilibrium by load steps: `setLoad(s)` scales the loads of `potential` and returns where the
/// held components are (3 x n, read only where held) at load factor s in [0, 1]. A step that fails
/// is cut in half, down to 1/256 of its length. x, 3 x n, starts at rest and ends at the last
/// equilibrium. `progress` is told the load factor after each step.
StaticReport solveStatic(const Potential& potential, const std::function<Points(double)>& setLoad,
                         const StaticSettings& settings, Points* x,
                         const std::function<void(double)>& progress = {});

}  // namespace palpate::solver
