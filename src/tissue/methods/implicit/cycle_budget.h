// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/solver/minimizer.h"
#include "palpate/tissue/fem/fem_tissue.h"

namespace palpate::tissue {

/// Budget of Newton iterations of a cycle, which bounds the cost without convergence: those of a
/// few solves, more for each later attempt and for each stage. Line search halvings count as
/// fractions.
class CycleBudget {
 public:
  /// Budgets of the first attempt and of each later one, in units of max_newton_iterations [-].
  static constexpr int kSolvesACycle = 4, kSolvesATrial = 1;
  /// Iterations of a stage before the last, and addition to the budget per stage.
  static constexpr int kStageIterations = 4;
  /// Line search halvings with the cost of one iteration [-].
  static constexpr int kHalvingsForOne = 8;

  /// `iterations_for_one`: see Minimizer::iterationsForOne().
  CycleBudget(const FemSettings& settings, int iterations_for_one)
      : settings_(settings), iterations_for_one_(iterations_for_one) {}

  void beginCycle() { trials_ = stages_ = iterations_ = halvings_ = 0; }
  void beginTrial() { ++trials_; }
  void beginStage() { ++stages_; }
  void spend(const solver::NewtonReport& report);

  /// Iterations left in this attempt; may be negative. Unbounded with FemSettings::only_converged.
  int left() const;
  /// Iterations of the next solve, in a stage before the last or in the last: at least one.
  int ofNextSolve(bool on_the_way) const;

 private:
  const FemSettings& settings_;
  int iterations_for_one_;
  int trials_ = 0, stages_ = 0;
  int iterations_ = 0, halvings_ = 0;
};

}  // namespace palpate::tissue
