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
  /// Null: one thread. With two, factorisations are done beside. Must outlive the minimiser.
  ThreadPool* pool = nullptr;
  /// See Newton; the others have no use for it.
  bool keep_stiffness = false;
};

/// Ways to take an implicit step; the first is the default.
std::vector<std::string> minimizerNames();

/// `A` has the body's pattern.
/// @throws std::invalid_argument for a name that is not one of minimizerNames().
std::unique_ptr<Minimizer> makeMinimizer(const std::string& name, const MinimizerSettings& settings,
                                         const fem::Stiffness& A);

}  // namespace palpate::solver
