// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "palpate/solver/minimizer.h"
#include "palpate/tissue/fem/fem_tissue.h"

namespace palpate::tissue {

/// How much work a cycle may still take, in Newton's iterations, so that what does not converge
/// costs a bounded time: those of a few solves, and more for each trial after the first and for
/// each stage on the tools' way. Trials of a line search count for a part of one.
class CycleBudget {
 public:
  /// Of the first trial, and what each one after it adds: times those that a solve may take.
  static constexpr int kSolvesACycle = 4, kSolvesATrial = 1;
  /// On the tools' way, and what each stage adds.
  static constexpr int kStageIterations = 4;
  /// That cost as much as an iteration.
  static constexpr int kHalvingsForOne = 8;

  /// `iterations_for_one`: see Minimizer::iterationsForOne().
  CycleBudget(const FemSettings& settings, int iterations_for_one)
      : settings_(settings), iterations_for_one_(iterations_for_one) {}

  void beginCycle() { trials_ = stages_ = iterations_ = halvings_ = 0; }
  void beginTrial() { ++trials_; }
  void beginStage() { ++stages_; }
  void spend(const solver::NewtonReport& report);

  /// Iterations left in this trial; may be negative. A case that has to converge takes what it
  /// takes.
  int left() const;
  /// Iterations of the next solve, on the tools' way or at the end of it: at least one.
  int ofNextSolve(bool on_the_way) const;

 private:
  const FemSettings& settings_;
  int iterations_for_one_;
  int trials_ = 0, stages_ = 0;
  int iterations_ = 0, halvings_ = 0;
};

}  // namespace palpate::tissue
