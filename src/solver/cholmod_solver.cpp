// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/solver/cholmod_solver.h"

#include "cholmod_factor.h"

namespace palpate::solver {

CholmodSolver::CholmodSolver() : factor_(std::make_unique<CholmodFactor>()) {}
CholmodSolver::~CholmodSolver() = default;

LinearReport CholmodSolver::solve(const fem::Stiffness& A, const Points& b, double, Points* x) {
  if (!b.allFinite()) return {SolveStatus::kNonFinite, 0};
  const SolveStatus status = factor_->factorize(A);
  if (status != SolveStatus::kConverged) return {status, 0};
  return {factor_->solve(b, x), 0};
}

}  // namespace palpate::solver
