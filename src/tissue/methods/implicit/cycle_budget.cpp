// SPDX-License-Identifier: GPL-3.0-or-later
#include "cycle_budget.h"

#include <algorithm>

namespace palpate::tissue {

void CycleBudget::spend(const solver::NewtonReport& report) {
  iterations_ += report.iterations;
  halvings_ += report.halvings;
}

int CycleBudget::left() const {
  const int of_solve = settings_.max_newton_iterations;
  if (settings_.only_converged) return of_solve;
  const int solves = kSolvesACycle + kSolvesATrial * std::max(0, trials_ - 1);
  const int spent = iterations_ / iterations_for_one_ + halvings_ / kHalvingsForOne;
  return solves * of_solve + kStageIterations * stages_ - spent;
}

int CycleBudget::ofNextSolve(bool on_the_way) const {
  return std::clamp(left(), 1, on_the_way ? kStageIterations : settings_.max_newton_iterations);
}

}  // namespace palpate::tissue
