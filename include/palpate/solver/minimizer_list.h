// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/base/thread_pool.h"
#include "palpate/solver/minimizer.h"

namespace palpate::solver {

struct MinimizerSettings {
  int max_linear_iterations = StepSettings().max_linear_iterations;
  /// Null: one thread. With two threads, factorisations are background tasks.
  /// @pre Outlives the minimiser.
  ThreadPool* pool = nullptr;
  /// See Newton; the others have no use for it.
  bool keep_stiffness = false;
  /// Where nodes are, 3 x n, for BlockPcg; empty: it does without.
  Points points = {};
};

/// Ways to take an implicit step; the first is the default.
std::vector<std::string> minimizerNames();

/// How the linear systems of a step are solved.
enum class LinearSystems {
  kNone,        ///< There are none.
  kIterations,  ///< By iterations from the matrix alone: their number grows with its condition.
  kFactor,      ///< By a factor of each cycle: time grows with the square of the nodes.
  kOldFactor    ///< By an earlier factor, alone or as preconditioner.
};

/// What a way to take a step is.
struct MinimizerFacts {
  LinearSystems linear_systems = LinearSystems::kNone;
  bool wants_fast_blas = false;  ///< Its steps may wait for factorisations, the work of BLAS.
  bool shares_linear = false;    ///< All threads work on a linear system.
  bool for_auto = false;         ///< The method `auto` of tissues may choose it.
};

/// @throws std::invalid_argument for a name that is not one of minimizerNames().
MinimizerFacts minimizerFacts(const std::string& name);

/// `A` has the body's pattern.
/// @throws std::invalid_argument for a name that is not one of minimizerNames().
std::unique_ptr<Minimizer> makeMinimizer(const std::string& name, const MinimizerSettings& settings,
                                         fem::Stiffness A);

}  // namespace palpate::solver
